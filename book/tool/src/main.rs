//! The preprocessor executable: reads the book from standard input and writes it to standard output.

use anyhow::Result;
use book_tool::Equations;
use mdbook_preprocessor::Preprocessor;
use std::io;

fn main() -> Result<()> {
    // mdBook calls `supports RENDERER`; exit status 0 means that the renderer is supported.
    if std::env::args().nth(1).is_some_and(|command| command == "supports") {
        return Ok(());
    }
    let (context, book) = mdbook_preprocessor::parse_input(io::stdin())?;
    serde_json::to_writer(io::stdout(), &Equations.run(&context, book)?)?;
    Ok(())
}
