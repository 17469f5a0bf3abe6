//! `sortie completions` and `sortie man`: generated from the definition of the command line.

use std::fs;
use std::io::{self, Write as _};
use std::path::Path;
use std::process::ExitCode;

use clap::{Command, CommandFactory as _};
use clap_complete::Shell;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};

use super::{CliArguments, Failure};
use crate::language;

/// Prints the completions of a shell.
pub(super) fn completions(shell: Shell) -> Result<ExitCode, Failure> {
    // The generator panics on a write error, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut CliArguments::command(), "sortie", &mut script);
    io::stdout().write_all(&script)?;
    Ok(ExitCode::SUCCESS)
}

/// Prints the manual page: the program, its subcommands, and the language of commands. With a folder, writes it there
/// with a page for each subcommand.
pub(super) fn man(folder: Option<&Path>) -> Result<ExitCode, Failure> {
    let Some(folder) = folder else {
        io::stdout().write_all(&page()?)?;
        return Ok(ExitCode::SUCCESS);
    };
    fs::create_dir_all(folder)?;
    for (file, page) in pages()? {
        fs::write(folder.join(file), page)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The manual page, and a page for each subcommand, by the names of their files.
fn pages() -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut program = CliArguments::command();
    program.build();
    let mut pages = vec![("sortie.1".to_owned(), page()?)];
    for command in program.get_subcommands() {
        page_of(command, &mut pages)?;
    }
    Ok(pages)
}

/// Adds the manual pages of a subcommand and of those below it.
fn page_of(command: &Command, pages: &mut Vec<(String, Vec<u8>)>) -> io::Result<()> {
    if command.get_name() == "help" {
        return Ok(());
    }
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_description_section(&mut page)?;
    man.render_options_section(&mut page)?;
    if command.has_subcommands() {
        man.render_subcommands_section(&mut page)?;
    }
    examples(command, &mut page)?;
    pages.push((man.get_filename(), page));
    for below in command.get_subcommands() {
        page_of(below, pages)?;
    }
    Ok(())
}

fn page() -> io::Result<Vec<u8>> {
    let program = CliArguments::command();
    let man = Man::new(program.clone());
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_description_section(&mut page)?;
    man.render_options_section(&mut page)?;
    examples(&program, &mut page)?;
    for command in program.get_subcommands() {
        subcommand("sortie", command, &mut page)?;
    }
    let mut roff = Roff::new();
    roff.control("SH", ["THE LANGUAGE OF COMMANDS"]);
    as_written(&mut roff, &language::manual());
    roff.control("SH", ["EXIT STATUS"]);
    as_written(&mut roff, super::EXIT_CODES);
    roff.to_writer(&mut page)?;
    man.render_version_section(&mut page)?;
    Ok(page)
}

/// Writes the sections of a subcommand and of those below it.
fn subcommand(parent: &str, command: &Command, page: &mut Vec<u8>) -> io::Result<()> {
    let name = format!("{parent} {}", command.get_name());
    let man = Man::new(command.clone().bin_name(name.clone()));
    let mut roff = Roff::new();
    roff.control("SH", [name.to_uppercase().as_str()]);
    roff.to_writer(page)?;
    let mut inner = Vec::new();
    man.render_synopsis_section(&mut inner)?;
    man.render_description_section(&mut inner)?;
    man.render_options_section(&mut inner)?;
    examples(command, &mut inner)?;
    // A subcommand's sections lie one level below its name.
    let inner = String::from_utf8_lossy(&inner).replace(".SH ", ".SS ");
    page.extend_from_slice(inner.as_bytes());
    let below = command.get_subcommands();
    below
        .into_iter()
        .try_for_each(|command| subcommand(&name, command, page))
}

/// Writes the text after a command's help: its examples.
fn examples(command: &Command, page: &mut Vec<u8>) -> io::Result<()> {
    let Some(text) = command.get_after_help() else {
        return Ok(());
    };
    let mut roff = Roff::new();
    roff.control("SH", ["EXAMPLES"]);
    let text = text.to_string();
    as_written(&mut roff, text.strip_prefix("Examples:\n").unwrap_or(&text));
    roff.to_writer(page)
}

/// Writes lines with their breaks and their indentation.
fn as_written(roff: &mut Roff, text: &str) {
    roff.control("nf", []);
    for line in text.lines() {
        roff.text([roman(line)]);
    }
    roff.control("fi", []);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definitions_are_consistent() {
        CliArguments::command().debug_assert();
    }

    #[test]
    fn every_command_shows_examples() {
        fn without(parent: &str, command: &Command, found: &mut Vec<String>) {
            let name = format!("{parent}{}", command.get_name());
            if !command.has_subcommands() && command.get_after_help().is_none() {
                found.push(name.clone());
            }
            for below in command.get_subcommands() {
                without(&format!("{name} "), below, found);
            }
        }
        let mut found = Vec::new();
        without("", &CliArguments::command(), &mut found);
        assert!(found.is_empty(), "no examples: {}", found.join(", "));
    }

    #[test]
    fn the_page_has_every_command_and_every_verb() {
        let page = String::from_utf8(page().expect("memory takes it")).expect("it is text");
        for command in CliArguments::command().get_subcommands() {
            let heading = format!(".SH \"SORTIE {}\"", command.get_name().to_uppercase());
            assert!(page.contains(&heading), "{heading}");
        }
        for row in language::rows() {
            assert!(page.contains(row.name()), "{}", row.name());
        }
    }

    #[test]
    fn every_subcommand_has_a_page() {
        let pages = pages().expect("memory takes it");
        let text = |file: &str| {
            let found = pages.iter().find(|(name, _)| name == file);
            let (_, page) = found.unwrap_or_else(|| panic!("no {file}"));
            String::from_utf8_lossy(page).into_owned()
        };
        assert!(text("sortie.1").contains("THE LANGUAGE OF COMMANDS"));
        assert!(text("sortie-fly.1").contains("sortie fly 05 \\-\\-design"));
        assert!(text("sortie-hangar.1").contains("sortie\\-hangar\\-status"));
        assert!(text("sortie-hangar-status.1").contains(".TH sortie-hangar-status 1"));
        assert!(pages.iter().all(|(name, _)| !name.contains("help")));
    }
}
