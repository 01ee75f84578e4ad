//! The preprocessor as mdBook runs it: the book comes on standard input and goes to standard output.

use anyhow::Result;
use book_tool::Equations;
use mdbook_preprocessor::Preprocessor;
use std::io;

fn main() -> Result<()> {
    // mdBook asks `supports RENDERER`; the answer is the exit status, and it is yes.
    if std::env::args().nth(1).is_some_and(|command| command == "supports") {
        return Ok(());
    }
    let (context, book) = mdbook_preprocessor::parse_input(io::stdin())?;
    serde_json::to_writer(io::stdout(), &Equations.run(&context, book)?)?;
    Ok(())
}
