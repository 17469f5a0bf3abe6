//! Files that the console reads and writes for its user: parameters, designs, and the history of the command line.

use super::Console;
use crate::app::effect::Effect;
use crate::app::event::Event;
use crate::app::update;
use crate::store::{self, Source, StoreError};
use crate::text::Text;

impl Console {
    /// Asks for parameters, or reads or writes a file of them, or of a design. What comes of it is never an effect.
    pub(super) fn files(&mut self, effect: Effect) {
        let event = match effect {
            Effect::FetchParameters(vehicles) => {
                return self
                    .running
                    .iter()
                    .for_each(|running| running.fetch_parameters(&vehicles));
            }
            Effect::ReadParameters { path } => {
                match store::read(&store::user_path(&path), "file-parameters") {
                    Ok(Source { text, .. }) => Event::ParametersRead { path, text },
                    Err(error) => Event::Failed(Text::from(&error)),
                }
            }
            Effect::SaveParameters {
                path,
                text,
                replace,
            } => match store::write(&store::user_path(&path), &text, replace) {
                Ok(()) => Event::ParametersSaved { path },
                Err(StoreError::Exists { .. }) => Event::ParametersExist { path, text },
                Err(error) => Event::Failed(Text::from(&error)),
            },
            Effect::ReadDesign { path } => {
                match store::read(&store::user_path(&path), "file-design") {
                    Ok(Source { text, .. }) => Event::DesignRead { path, text },
                    Err(error) => Event::Failed(Text::from(&error)),
                }
            }
            Effect::WriteDesign {
                path,
                text,
                replace,
            } => match store::write(&store::user_path(&path), &text, replace) {
                Ok(()) => Event::DesignWritten { path },
                Err(StoreError::Exists { .. }) => Event::DesignExists { path, text },
                Err(error) => Event::Failed(Text::from(&error)),
            },
            _ => return,
        };
        update(&mut self.state, event);
    }

    /// Writes a line that is new in the history to its file. A folder on a slow disk holds up nothing.
    pub(super) fn keep_line(&mut self) {
        let newest = self.state.history.back();
        let Some(history) = self.options.preferences.history.clone() else {
            return;
        };
        if let Some(line) = newest.filter(|line| self.kept.as_ref() != Some(*line)) {
            let line = line.clone();
            self.kept = Some(line.clone());
            tokio::task::spawn_blocking(move || {
                if let Err(error) = history.add(&line) {
                    tracing::warn!(%error, "the history of the command line was not written");
                }
            });
        }
    }
}
