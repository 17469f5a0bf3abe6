//! The verb about the files of vehicles.

use super::{command, question};
use crate::commands::{Command, FileCommand, last_part};
use crate::language::argument::{Argument, Arguments, Kind, Problem};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::text;

pub(super) static ROWS: &[VerbRow] = &[FTP];

/// What separates the two paths of a copy.
const TO: &str = " to ";

const PATH: Argument = Argument::value("path", Kind::Rest, "argument-vehicle-path");

const FTP: VerbRow = VerbRow {
    verb: question("ftp"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "ftp list",
        "ftp list /APM/LOGS",
        "ftp get @SYS/tasks.txt",
        "2 ftp get /scripts/a.lua to ~/a.lua",
        "2 ftp put ~/a.lua to /scripts/a.lua",
        "ftp checksum /scripts/a.lua",
        "ftp mkdir /scripts",
        "ftp remove /scripts/a.lua",
        "ftp stop",
    ],
    forms: &[
        Form::new(&[Argument::flag("stop", "")], |_| {
            command(Command::File(FileCommand::Stop))
        }),
        Form::new(&[Argument::flag("list", ""), PATH.optional()], |given| {
            let folder = match written(given) {
                "" => "/",
                folder => folder,
            };
            command(Command::File(FileCommand::List {
                folder: folder.to_owned(),
            }))
        }),
        Form::new(&[Argument::flag("get", ""), PATH], |given| {
            let (path, to) = match written(given).rsplit_once(TO) {
                Some((path, to)) => (path.trim(), Some(to.trim().to_owned())),
                None => (written(given), None),
            };
            command(Command::File(FileCommand::Get {
                path: path.to_owned(),
                to,
            }))
        }),
        Form::new(&[Argument::flag("put", ""), PATH], |given| {
            let Some((file, place)) = written(given).rsplit_once(TO) else {
                return Err(Problem::new("path", text!("grammar-put-where")));
            };
            let path = match place.trim() {
                folder if folder.ends_with('/') => format!("{folder}{}", last_part(file.trim())),
                path => path.to_owned(),
            };
            let file = file.trim().to_owned();
            command(Command::File(FileCommand::Put { file, path }))
        }),
        Form::new(&[Argument::flag("checksum", ""), PATH], |given| {
            let path = written(given).to_owned();
            command(Command::File(FileCommand::Checksum { path }))
        }),
        Form::new(&[Argument::flag("mkdir", ""), PATH], |given| {
            let path = written(given).to_owned();
            command(Command::File(FileCommand::MakeFolder { path }))
        }),
        Form::new(&[Argument::flag("remove", ""), PATH], |given| {
            let path = written(given).to_owned();
            command(Command::File(FileCommand::Remove { path }))
        }),
    ],
};

/// The paths of a line, as they were typed.
fn written(given: &Arguments) -> &str {
    given.word("path").unwrap_or_default().trim()
}
