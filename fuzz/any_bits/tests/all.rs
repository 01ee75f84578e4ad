//! Random bytes as arguments; `PROPTEST_CASES` sets their number.

use proptest::collection::vec;
use proptest::num::u8::ANY;
use proptest::proptest;

proptest! {
    #[test]
    fn any_text_is_a_number_or_refused(bytes in vec(ANY, 40)) {
        any_bits::parse(&bytes);
    }

    #[test]
    fn any_answer_is_assessed_or_refused(bytes in vec(ANY, 128)) {
        any_bits::read(&bytes);
    }

    #[test]
    #[ignore = "proves all claims and refutes their mutations first"]
    fn no_changed_proof_proves_a_false_statement(bytes in vec(ANY, 112)) {
        any_bits::prove_nothing(&bytes);
    }
}
