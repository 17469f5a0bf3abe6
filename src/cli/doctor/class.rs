//! The class that the configuration names.

use super::super::settings::{CliSettings, class};
use super::HostFinding;
use crate::carrier::ClassPlace;

/// The class of the configuration, as far as one is set.
pub(super) fn of_configuration(settings: &CliSettings) -> Vec<HostFinding> {
    let set = &settings.config.class;
    let words = [
        ("class.join", &set.join),
        ("class.instructor", &set.instructor),
    ];
    let set = words
        .into_iter()
        .filter_map(|(name, word)| Some((name, word.as_ref()?)));
    let finding = |(name, word): (&str, &String)| match class::check(name, word) {
        Ok(()) => {
            // A join line contains a secret, which its place does not.
            let place = (name == "class.join").then(|| ClassPlace::named(word, None).ok());
            let place = place.flatten().map(|it| it.to_string());
            HostFinding::ok(
                "class",
                format!("{name}: {}", place.as_ref().unwrap_or(word)),
            )
        }
        Err(fault) => {
            let mend = fault.help.map_or_else(String::new, |help| help.to_string());
            HostFinding::fault("class", format!("{name}: {}", fault.message), mend)
        }
    };
    set.map(finding).collect()
}
