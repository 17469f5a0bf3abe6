//! `sortie plan convert`: writes a plan file in another format.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::{Failure, ShapeArguments, invalid, load};
use crate::cli::fault::FileFault;
use crate::plan::{Document, FileFormat, ListKind, Unwritable, write};
use crate::preflight::{self, list_words};
use crate::store;
use crate::text;
use crate::text::{Locale, Text};

/// Options of `sortie plan convert`.
#[derive(Debug, Args)]
pub(super) struct ConvertArguments {
    /// The file to read, of any format.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The file to write; its extension decides the format.
    #[arg(value_name = "OUT")]
    output: PathBuf,
    /// Write only this list.
    #[arg(long, value_enum)]
    list: Option<List>,
    /// Replace OUT if it exists.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    shapes: ShapeArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum List {
    Plan,
    Fence,
    Rally,
}

impl From<List> for ListKind {
    fn from(list: List) -> Self {
        match list {
            List::Plan => Self::Plan,
            List::Fence => Self::Fence,
            List::Rally => Self::Rally,
        }
    }
}

pub(super) fn convert(options: &ConvertArguments, locale: &Locale) -> Result<ExitCode, Failure> {
    let ending = options
        .output
        .extension()
        .and_then(|ending| ending.to_str());
    let format = ending.and_then(FileFormat::of_ending).ok_or_else(|| {
        Failure::Invalid(format!(
            "sortie: unknown format of {}: expected a name ending in .waypoints, .fence, .rally, .plan, .kml or .geojson",
            options.output.display()
        ))
    })?;
    let loaded = load(&options.input, options.shapes.options()).map_err(FileFault::failure)?;
    let name = options.input.display().to_string();
    for remark in preflight::remarks(&loaded, &[]) {
        let line = remark.diagnostic.text(&name, &loaded.text);
        tell!("{}", locale.text(&line));
    }
    let mut document = loaded.document;
    let mut format = format;
    if let Some(list) = options.list.map(ListKind::from) {
        for other in ListKind::ALL.into_iter().filter(|other| *other != list) {
            document.list_mut(other).clear();
        }
        if let FileFormat::Wpl(kind) = &mut format {
            *kind = list;
        }
    }
    let text = write(&document, format).map_err(|reason| invalid(&lost(reason), locale))?;
    store::write(&options.output, &text, options.force)
        .map_err(|error| invalid(&Text::from(&error), locale))?;
    let path = options.output.display().to_string();
    let content = preflight::summary(&document);
    say!(
        "{}",
        locale.text(&text!("plan-written", path = path, content = content))
    )?;
    Ok(ExitCode::SUCCESS)
}

/// The text that explains why a format cannot hold a document.
pub(super) fn lost(reason: Unwritable) -> Text {
    match reason {
        Unwritable::List(kind) => text!("plan-would-lose", list = list_words(kind)),
        Unwritable::RallyFrame(index) => text!("plan-would-lose-frame", number = index + 1),
        Unwritable::FenceShape(index) => text!("plan-would-lose-fence", number = index + 1),
        Unwritable::Infinite(kind, index) => text!(
            "plan-would-lose-infinite",
            list = list_words(kind),
            number = index + 1
        ),
    }
}

/// The file name and the text of a document in the name's format; if that format can only be read,
/// those of a `.plan`.
pub(super) fn written(name: &str, document: &Document) -> Result<(String, String), Unwritable> {
    let (stem, ending) = name.rsplit_once('.').unwrap_or((name, ""));
    match FileFormat::of_ending(ending) {
        Some(format) => Ok((name.to_owned(), write(document, format)?)),
        None => Ok((
            format!("{stem}.plan"),
            write(document, FileFormat::QgcPlan)?,
        )),
    }
}
