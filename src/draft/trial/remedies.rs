//! The changes that keep drafts apart.

use std::sync::Arc;

use super::{TrialDraft, Tried};
use crate::rehearsal::Remedy;
use crate::text;
use crate::text::{Text, figure};

/// The changes that keep some drafts apart.
#[derive(Debug)]
pub(super) struct TrialRemedies<'a> {
    pub drafts: &'a [TrialDraft],
    /// The remedies, in the order of the drafts.
    pub remedies: &'a [Remedy],
}

impl TrialRemedies<'_> {
    /// The changed drafts, and the changes in words; `flown` is the outcome with them.
    pub fn tried(&self, flown: Tried) -> Tried {
        if !self.remedies.iter().copied().any(is_needed) {
            let text = Text::joined("; ", vec![text!("plan-deconflict-none"), flown.text]);
            return Tried { text, ..flown };
        }
        let changed = self.changed();
        Tried {
            text: Text::joined("; ", self.words(&changed)),
            changed,
            ..flown
        }
    }

    /// The drafts whose content changes, and every draft with a sharer.
    fn changed(&self) -> Vec<TrialDraft> {
        let changed = self.all().filter_map(|(remedy, draft)| {
            let is_other = is_needed(remedy) || draft.sharer.is_some();
            is_other.then(|| TrialDraft {
                document: Arc::new(remedy.apply(&draft.document)),
                ..draft.clone()
            })
        });
        changed.collect()
    }

    fn words(&self, changed: &[TrialDraft]) -> Vec<Text> {
        let words = self.all().filter_map(|(remedy, draft)| {
            let name = draft.name.as_str();
            match remedy {
                Remedy::Nothing => None,
                Remedy::Delay(seconds) => {
                    Some(text!("draft-trial-delay", name = name, seconds = seconds))
                }
                Remedy::Layer(metres) => {
                    let height = figure(metres, 0);
                    Some(text!("draft-trial-layer", name = name, height = height))
                }
            }
        });
        let mut remedies = self.remedies.iter();
        let waits = remedies.any(|it| matches!(it, Remedy::Delay(_)));
        let splits = changed.iter().any(|draft| draft.sharer.is_some());
        let notes = [
            waits.then(|| text!("draft-trial-disarm")),
            splits.then(|| text!("draft-trial-split")),
        ];
        words.chain(notes.into_iter().flatten()).collect()
    }

    fn all(&self) -> impl Iterator<Item = (Remedy, &TrialDraft)> {
        self.remedies.iter().copied().zip(self.drafts)
    }
}

fn is_needed(remedy: Remedy) -> bool {
    remedy != Remedy::Nothing
}
