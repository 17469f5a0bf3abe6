//! The `sortie` program; everything is in the library.

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    sortie::cli::main(sortie::cli::Arguments::parse())
}
