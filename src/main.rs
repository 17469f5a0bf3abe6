//! The `sortie` program; everything is in the library.

use std::process::ExitCode;

use clap::Parser as _;
use sortie::hangar;

fn main() -> ExitCode {
    // A hangar starts this program to turn it into another one; this is not a command for users.
    let words: Vec<_> = std::env::args_os().skip(1).collect();
    if let [first, order @ ..] = words.as_slice()
        && first == hangar::LAUNCH
    {
        return hangar::launch_stub(order);
    }
    match sortie::cli::CliArguments::try_parse() {
        Ok(arguments) => sortie::cli::main(arguments),
        Err(outcome) => sortie::cli::refuse(&outcome),
    }
}
