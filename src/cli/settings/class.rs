//! The class of the configuration: whether consoles could join it.

use nix::unistd::User;

use crate::carrier::ClassPlace;
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// Checks a word of the section `class` against this machine. A class that is not open yet is no fault.
///
/// # Errors
/// There is no such folder or user, or the file is not one with a join line that can be used.
pub fn check(setting: &str, word: &str) -> Result<(), Diagnostic> {
    match setting {
        "class.join" => check_join(word),
        "class.instructor" => check_instructor(word),
        _ => Ok(()),
    }
}

fn check_join(word: &str) -> Result<(), Diagnostic> {
    let fault = |text: Text, help: Text| {
        let fault = Diagnostic::new(0..word.len(), text);
        Err(fault.with_help(help))
    };
    match ClassPlace::named(word, None) {
        Err(found) => fault(Text::from(&found), text!("class-setting-join-help")),
        // One that is named without a path is in /tmp, and made when the desk is opened.
        Ok(place) if word.contains('/') => match place.missing_folder() {
            Some(folder) => fault(
                text!(
                    "class-setting-folder",
                    folder = folder.display().to_string()
                ),
                text!("class-setting-folder-help"),
            ),
            None => Ok(()),
        },
        Ok(_) => Ok(()),
    }
}

fn check_instructor(word: &str) -> Result<(), Diagnostic> {
    // What the system does not say is no fault of the setting.
    if !matches!(User::from_name(word), Ok(None)) {
        return Ok(());
    }
    let fault = Diagnostic::new(0..word.len(), text!("class-setting-user", user = word));
    Err(fault.with_help(text!("class-setting-user-help")))
}
