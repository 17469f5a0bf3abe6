//! Status texts of vehicles.

use crate::vehicle::{StatusText, Vehicle};

/// Collects the status texts of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct TextListener {
    last: Option<StatusText>,
    begun: bool,
}

impl TextListener {
    /// The texts since the last call; those before the first call are skipped.
    pub fn listen<'a>(&mut self, vehicle: &'a Vehicle) -> &'a [StatusText] {
        let texts = &vehicle.texts;
        let known = match &self.last {
            Some(last) => texts
                .iter()
                .rposition(|text| text == last)
                .map_or(0, |at| at + 1),
            None if self.begun => 0,
            None => texts.len(),
        };
        self.begun = true;
        self.last = texts.last().cloned();
        &texts[known..]
    }
}
