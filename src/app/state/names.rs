//! The names that commands may use, besides vehicles and places.

use std::fmt;

use super::State;
use crate::app::lines::themes;
use crate::app::room_list::Room;
use crate::language::{Listed, NameList, Named, Names};
use crate::text;
use crate::text::Text;

impl<R: fmt::Debug> Names for State<R> {
    fn listed(&self, list: NameList) -> Listed {
        match list {
            NameList::Room => Room::listed(),
            NameList::Theme => themes(&self.display.themes),
            NameList::Mission => {
                let missions = self.training.missions.iter();
                Listed::Names(missions.map(|it| named(&it.id, it.title.clone())).collect())
            }
            NameList::Inject => self.injects(),
            // The rooms check these names.
            NameList::Draft | NameList::ItemField => Listed::Anything,
            NameList::PlanFile => Listed::Names(self.typing.plan_files()),
            NameList::Macro => {
                let macros = self.config.macros.iter();
                let meaning = |lines: &[String]| Text::verbatim(lines.join("; "));
                Listed::Names(
                    macros
                        .map(|(name, lines)| named(name, meaning(lines)))
                        .collect(),
                )
            }
        }
    }
}

impl<R> State<R> {
    fn injects(&self) -> Listed {
        let Some(mission) = &self.session.task.progress else {
            return Listed::Nothing(text!("console-no-mission"));
        };
        if mission.injects.is_empty() {
            return Listed::Nothing(text!("console-no-injects"));
        }
        let injects = mission.injects.iter();
        Listed::Names(
            injects
                .map(|it| named(&it.name, it.title.clone()))
                .collect(),
        )
    }
}

fn named(name: &str, meaning: Text) -> Named {
    Named {
        name: name.to_owned(),
        meaning,
    }
}
