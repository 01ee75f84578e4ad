//! Indented JSON with deeply nested values on one line.

use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter};
use std::io::{self, Write};

/// Nesting from which arrays and objects are on one line.
const INLINE_DEPTH: usize = 8;

/// A formatter of JSON.
#[derive(Default)]
pub struct Indented {
    pretty: PrettyFormatter<'static>,
    depth: usize,
}

/// Calls a method of the formatter for the depth.
macro_rules! by_depth {
    ($self:ident.$method:ident($($argument:expr),+)) => {
        if $self.depth < INLINE_DEPTH { $self.pretty.$method($($argument),+) } else { CompactFormatter.$method($($argument),+) }
    };
}

impl Formatter for Indented {
    fn begin_array<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.depth += 1;
        by_depth!(self.begin_array(to))
    }

    fn end_array<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        let ended = by_depth!(self.end_array(to));
        self.depth -= 1;
        ended
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        by_depth!(self.begin_array_value(to, first))
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        by_depth!(self.end_array_value(to))
    }

    fn begin_object<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.depth += 1;
        by_depth!(self.begin_object(to))
    }

    fn end_object<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        let ended = by_depth!(self.end_object(to));
        self.depth -= 1;
        ended
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        by_depth!(self.begin_object_key(to, first))
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        by_depth!(self.begin_object_value(to))
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        by_depth!(self.end_object_value(to))
    }
}
