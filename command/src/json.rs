//! JSON lines from external programs: lines of limited length, and objects in their original spelling.

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::fmt;
use std::io::{self, BufRead, BufReader, Read};

/// Number of bytes read at once.
pub const BUFFER: usize = 1 << 16;

/// Waits for a line and returns it with the lines that arrived with it, at most `most`. Bytes of a line
/// beyond `longest` and one are discarded.
pub fn read_lines(
    from: &mut BufReader<impl Read>,
    most: usize,
    longest: usize,
    lines: &mut Vec<u8>,
) -> io::Result<()> {
    for _ in 0..most {
        let start = lines.len();
        from.by_ref().take(longest as u64 + 1).read_until(b'\n', lines)?;
        if lines.get(start + longest).is_some_and(|byte| *byte != b'\n') {
            from.skip_until(b'\n')?;
            lines.push(b'\n');
        }
        if !from.buffer().contains(&b'\n') {
            break;
        }
    }
    Ok(())
}

/// Keys and values of an object in their original spelling.
pub struct Object<'a>(pub Vec<(String, &'a RawValue)>);

impl<'a> Object<'a> {
    /// Returns the value of a key, the first if there are several.
    pub fn get(&self, key: &str) -> Option<&'a RawValue> {
        self.0.iter().find(|(other, _)| other == key).map(|(_, value)| *value)
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for Object<'a> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = Object<'de>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }
            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Object<'de>, M::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Object(entries))
            }
        }
        from.deserialize_map(Entries)
    }
}

/// Returns the contents of a string, or the original spelling of any other value, so that nothing is lost.
pub fn text(value: &RawValue) -> Cow<'_, str> {
    let spelling = value.get();
    // Reading a number as a string would construct an error, which takes longer than to read the number.
    let content = if spelling.starts_with('"') { serde_json::from_str(spelling).ok() } else { None };
    content.map_or(Cow::Borrowed(spelling), Cow::Owned)
}
