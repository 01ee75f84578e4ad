//! An entry as JSON has it: every key always there.

use super::{Entry, claim_names};
use serde::ser::{Serialize, SerializeStruct, Serializer};

impl Serialize for Entry {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut entry = to.serialize_struct("Entry", 9)?;
        entry.serialize_field("equation", self.equation)?;
        entry.serialize_field("title", self.title)?;
        entry.serialize_field("section", self.section)?;
        entry.serialize_field("statement", &self.statement())?;
        entry.serialize_field("latex", &self.latex())?;
        entry.serialize_field("hypotheses", &self.format_hypotheses())?;
        entry.serialize_field("function", &self.functions.first())?;
        entry.serialize_field("follows_from", &self.follows_from)?;
        entry.serialize_field("claims", &claim_names(self.equation))?;
        entry.end()
    }
}
