//! Names of files: as typed, in a folder, and suggestions for those that are not found.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use crate::diagnostic::nearest;
use crate::text;
use crate::text::Text;

/// The maximum number of names offered from one folder.
const MOST_NAMES: usize = 1000;

/// The names in a folder, sorted and without hidden ones; names of folders end with `/`. Empty if
/// the folder cannot be read. An empty path is the working directory.
pub fn names_in(folder: &Path) -> Vec<String> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let named = entries.filter_map(|entry| {
        let name = entry.file_name().into_string().ok()?;
        let is_folder = || fs::metadata(entry.path()).is_ok_and(|it| it.is_dir());
        (!name.starts_with('.')).then(|| if is_folder() { name + "/" } else { name })
    });
    let mut names: Vec<String> = named.take(MOST_NAMES).collect();
    names.sort();
    names
}

/// A path as typed: `~/` is the home folder.
pub fn user_path(written: &str) -> PathBuf {
    let in_home = written.strip_prefix("~/").zip(etcetera::home_dir().ok());
    in_home.map_or_else(|| PathBuf::from(written), |(rest, home)| home.join(rest))
}

/// Why a file cannot be read; for a missing one, with the existing name or folder nearest to it.
pub fn unread(path: &Path, error: &io::Error) -> Text {
    let shown = path.display().to_string();
    match error.kind() {
        ErrorKind::NotFound => missing(path),
        ErrorKind::IsADirectory => text!("file-is-folder", path = shown),
        ErrorKind::PermissionDenied => text!("file-forbidden", path = shown),
        _ => text!("file-unreadable", path = shown, error = Text::from(error)),
    }
}

fn missing(path: &Path) -> Text {
    let shown = path.display().to_string();
    if let Ok(target) = fs::read_link(path) {
        let target = target.display().to_string();
        return text!("file-dangling", path = shown, target = target);
    }
    let folder = path.parent().unwrap_or(path);
    if !folder.as_os_str().is_empty() && !folder.is_dir() {
        let absent = first_missing(folder);
        let folder = absent.display().to_string();
        return match nearest_to(absent, true) {
            Some(name) => text!(
                "file-missing-folder-near",
                path = shown,
                folder = folder,
                name = name
            ),
            None => text!("file-missing-folder", path = shown, folder = folder),
        };
    }
    if let Some(name) = nearest_to(path, false) {
        return text!("file-missing-near", path = shown, name = name);
    }
    match env::current_dir() {
        Ok(here) if path.is_relative() => {
            let folder = here.join(folder).display().to_string();
            text!(
                "file-missing-in",
                path = shown,
                folder = folder.trim_end_matches('/')
            )
        }
        _ => text!("file-missing", path = shown),
    }
}

/// The topmost missing folder on the path to a missing one.
fn first_missing(folder: &Path) -> &Path {
    let above = folder
        .ancestors()
        .take_while(|it| !it.as_os_str().is_empty() && !it.is_dir());
    above.last().unwrap_or(folder)
}

/// The path of the file or folder with the most similar name in the same folder.
fn nearest_to(path: &Path, is_folder: bool) -> Option<String> {
    let folder = path.parent()?;
    let written = path.file_name()?.to_str()?;
    let names = names_in(folder);
    let of_kind = names.iter().filter(|name| name.ends_with('/') == is_folder);
    let name = nearest(written, of_kind.map(|name| name.trim_end_matches('/')))?;
    Some(folder.join(name).display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_file_is_named_with_the_nearest_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let here = folder.path().display().to_string();
        fs::create_dir(folder.path().join("plans")).expect("created");
        fs::write(folder.path().join("survey.plan"), "").expect("written");
        let said = |name: &str| {
            let path = folder.path().join(name);
            let error = fs::read(&path).expect_err("it is missing");
            unread(&path, &error).to_string().replace(&here, "DIR")
        };
        assert_eq!(
            said("survy.plan"),
            "DIR/survy.plan: not found; did you mean `DIR/survey.plan`?"
        );
        assert_eq!(said("other.txt"), "DIR/other.txt: not found");
        assert_eq!(
            said("plan/a/survey.plan"),
            "DIR/plan/a/survey.plan: no folder DIR/plan; did you mean `DIR/plans`?"
        );
        assert_eq!(
            said("elsewhere/x.plan"),
            "DIR/elsewhere/x.plan: no folder DIR/elsewhere"
        );
        assert_eq!(said("plans"), "DIR/plans is a folder, not a file");
        let error = fs::read("no-such-file.plan").expect_err("it is missing");
        let text = unread(Path::new("no-such-file.plan"), &error).to_string();
        let working = env::current_dir().expect("a folder");
        assert_eq!(
            text,
            format!("no-such-file.plan: not found in {}", working.display())
        );
    }
}
