//! Tables, and what is refused.

use super::*;
use spring_mass_contact::check::{AnswerVerdict, Family, check_table, problems};
use spring_mass_contact::rug::float::Round;

fn read_table(text: &str) -> Result<Table, String> {
    table(text, problems(1, 2, &[Family::Contact, Family::Stiff]))
}

/// Each line names what is wrong, and what is read instead.
#[test]
fn what_is_not_read_is_named() {
    let own = "id,deflection,contact_force,stiffness,mass,gravity,free_length,height";
    for (text, reason) in [
        ("", "the first line '' must name the column id; columns are named in the first line"),
        ("[\n{\"id\": \"contact-1\"}\n]", "the first line '[' must name the column id; columns"),
        ("ID\tDeflection\ncontact-1\t1", "the first line 'ID\u{fffd}Deflection' must name the column id"),
        // Blank lines, and lines that end as on old systems.
        ("id,deflection,contact_force\n\n\nx,1,2", "line 4: the id 'x' must be"),
        ("id,deflection,contact_force\rcontact-1,99,99\rx,1,2\r", "line 3: the id 'x' must be"),
        (
            "id;deflection;contact_force\ncontact-1;0,5;3",
            "the first line 'id;deflection;contact_force' must name the column id; columns",
        ),
        (
            "id,deflection,contact_force\ncontact-1,0,5,3",
            "CSV error: record 1 (line: 2, byte: 28): found record with 4 fields",
        ),
        (
            "id,deflection,contact_force\ncontact-1,\"0,5\",3",
            "line 2: invalid value '0,5' for 'deflection': not a",
        ),
        ("id,deflection,contact_force\ncontact-1,1,", "line 2: the key 'contact_force' is missing"),
        ("id,deflection,contact_force\n,1,2", "line 2: the key 'id' is missing"),
        ("id,deflection,contact_force\ncontact-1,,", "no row has an id"),
        (
            "id,deflection,contact_force\nx,1,2",
            "line 2: the id 'x' must be an id of contact cases with these options, or",
        ),
        (
            "id,deflection,contact_force\nstiff-1,1,2\nstiff-1,,",
            "line 3: the id 'stiff-1' is used multiple times",
        ),
        ("id,deflection,contact_force,id\nstiff-1,1,2,3", "line 2: the key 'id' used multiple times"),
        (&format!("{own}\na,1,2,3,4,,6,7"), "line 2: the key 'gravity' must be a number; a row has all five"),
        (&format!("{own}\na,1,2,0,4,5,6,7"), "line 2: stiffness 0: must be greater than 0"),
        (&format!("{own}\na,1,2,3,4,5,6,nan"), "line 2: the key 'height' must be a number; a row"),
        ("{\"id\": \"stiff-1\"}\n\nnext", "line 3: must be a JSON object"),
    ] {
        let found = read_table(text).err().unwrap_or_default();
        assert!(found.starts_with(reason), "{text}: {found}");
    }
}

/// CSV in any order, with other columns, with the parameters of another system, and JSON with a refusal.
#[test]
fn rows_are_answers_to_their_systems() {
    let ids = |all: &[Problem]| all.iter().map(|problem| problem.id.clone()).collect::<Vec<_>>().join(" ");
    let csv =
        "\u{feff}note,contact_force, deflection ,id\r\n\"a, b\",4.81,0.5,stiff-2\r\n,,,\r\n,,,contact-2\r\n";
    let (answers, missing) = read_table(csv).unwrap();
    let drawn = problems(1, 2, &[Family::Contact, Family::Stiff]);
    assert_eq!((ids(&missing), answers.len()), ("contact-2 contact-1 stiff-1".to_string(), 1));
    let (problem, Reply::Answered(answer)) = &answers[0] else { panic!("no answer") };
    let numbers = [&answer.deflection, &answer.contact_force].map(|x| x.as_ref().unwrap().to_string());
    assert_eq!((problem, numbers), (&drawn[3], ["1/2".to_string(), "481/100".to_string()]));
    let own = "id,stiffness,mass,gravity,free_length,height,deflection,contact_force\n";
    for (row, family) in [
        ("stiff-1,100,1,9.81,1,1.05,0.05,4.81", Family::Contact),
        ("mine,100,1,9.81,1,1.05,0.05,4.81", Family::Contact),
        ("mine,100,1,9.81,1,1.0981,0.0981,0", Family::Grazing),
        ("mine,100,1,9.81,1,2,0.0981,0", Family::Separated),
    ] {
        let (answers, missing) = read_table(&format!("{own}{row}")).unwrap();
        let report = check_table(answers, &"1e-6".parse().unwrap());
        let families: Vec<_> = report.families().iter().map(|row| (row.family, row.verdict)).collect();
        assert_eq!(families, [(family, AnswerVerdict::Right)]);
        assert_eq!(missing, []);
    }
    // The parameters of contact cases may be repeated.
    let SpringMass { c, m, g, l, h } = drawn[3].system.as_ref().map(|x| x.decimal(20, Round::Nearest));
    let (answers, missing) = read_table(&format!("{own}stiff-2,{c},{m},{g},{l},{h},0,0")).unwrap();
    assert_eq!((&answers[0].0, ids(&missing)), (&drawn[3], "contact-1 contact-2 stiff-1".to_string()));
    let json = "{\"id\": \"contact-1\", \"error\": \"no\"}\n{\"id\": \"contact-2\", \"deflection\": null, \"contact_force\": 1}";
    let (answers, missing) = read_table(json).unwrap();
    assert_eq!((answers.len(), ids(&missing)), (2, "stiff-1 stiff-2".to_string()));
    assert_eq!(answers[0].1, Reply::Refused("no".to_string()));
}

/// A table that is too long is refused, and not cut off.
#[test]
fn a_table_has_at_most_a_number_of_bytes() {
    let path = std::env::temp_dir().join(format!("contact-table-{}", std::process::id()));
    std::fs::write(&path, "id\n1").unwrap();
    let read = |most: u64| text(path.to_str().unwrap(), most);
    assert_eq!(
        (read(4), read(3)),
        (Ok("id\n1".to_string()), Err("must have no more than 3 bytes".to_string()))
    );
    std::fs::remove_file(path).unwrap();
}
