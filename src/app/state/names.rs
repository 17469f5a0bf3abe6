//! The names that commands may use, besides vehicles and places.

use std::collections::BTreeMap;
use std::fmt;

use super::{CrewPart, State};
use crate::app::lines::themes;
use crate::app::room_list::Room;
use crate::class::SeatRecord;
use crate::crew::Role;
use crate::language::{Listed, NameList, Named, Names};
use crate::text;
use crate::text::{Text, clock_s};

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
            NameList::Draft
            | NameList::ItemField
            | NameList::Lesson
            | NameList::Exam
            | NameList::Trainee
            | NameList::Rubric => Listed::Anything,
            NameList::PlanFile => Listed::Names(self.typing.plan_files()),
            NameList::Seat => self.seats(),
            NameList::SeatInject => self.seat_injects(),
            NameList::Situation => self.seat_situations(),
            NameList::Crew => self.crew_names(),
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
    fn seats(&self) -> Listed {
        let Some(desk) = self.class.desk() else {
            return Listed::Nothing(text!("class-no-desk"));
        };
        let seats = desk.seats().iter();
        let seats = seats.map(|seat| named(&format!("@{}", seat.name), seated(seat)));
        let all = named("@all", text!("class-all-seats"));
        Listed::Names(std::iter::once(all).chain(seats).collect())
    }

    /// The injects of all connected seats: which of them a line means is known only at its end.
    fn seat_injects(&self) -> Listed {
        let Some(desk) = self.class.desk() else {
            return Listed::Nothing(text!("class-no-desk"));
        };
        let here = desk.seats().iter().filter(|seat| seat.is_here());
        let flights = here.filter_map(|seat| seat.report.as_ref()?.flight.as_ref());
        let offered = flights.flat_map(|flight| &flight.injects);
        let titles: BTreeMap<&str, &str> = offered
            .map(|inject| (inject.name.as_str(), inject.title.as_str()))
            .collect();
        if titles.is_empty() {
            return Listed::Nothing(text!("class-no-injects"));
        }
        let named = |(name, title): (&str, &str)| named(name, Text::verbatim(title));
        Listed::Names(titles.into_iter().map(named).collect())
    }

    /// The situations of all connected seats: which of them a line means is known only at its end.
    fn seat_situations(&self) -> Listed {
        let Some(desk) = self.class.desk() else {
            return Listed::Nothing(text!("class-no-desk"));
        };
        let here = desk.seats().iter().filter(|seat| seat.is_here());
        let mut names: BTreeMap<String, Text> = BTreeMap::new();
        for seat in here {
            let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
            let situations = flight.map_or(&[][..], |it| &it.situations);
            for (number, it) in (1..).zip(situations) {
                let at = text!(
                    "class-situation-at",
                    seat = seat.name.as_str(),
                    name = it.name.as_str(),
                    at = clock_s(it.clock_s)
                );
                // A name of several words cannot be completed word by word.
                let is_word = it.is_named && !it.name.as_str().contains(char::is_whitespace);
                let name = is_word.then(|| it.name.to_string());
                names.insert(name.unwrap_or_else(|| number.to_string()), at);
            }
        }
        let named = names
            .into_iter()
            .map(|(name, meaning)| named(&name, meaning));
        Listed::Names(named.collect())
    }

    /// Everybody on the crew but the user of this console.
    fn crew_names(&self) -> Listed {
        let names: Vec<Named> = match &self.crew {
            CrewPart::None => return Listed::Nothing(text!("crew-none")),
            CrewPart::Host(crew) => {
                let members = crew.members();
                members
                    .map(|it| named(it.person.name(), it.role.text()))
                    .collect()
            }
            CrewPart::Member(place) => {
                let own = place.viewpoint.as_ref().map(|it| it.own.name());
                let others = place.roster.iter();
                let others = others.filter(|it| Some(it.name.as_str()) != own);
                others
                    .map(|it| {
                        let role = it.role.map_or_else(|| text!("crew-role-host"), Role::text);
                        named(it.name.as_str(), role)
                    })
                    .collect()
            }
        };
        if names.is_empty() {
            return Listed::Nothing(text!("crew-alone"));
        }
        Listed::Names(names)
    }

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

/// Who sits at a seat, and what is flown there.
fn seated(seat: &SeatRecord) -> Text {
    let Some(report) = &seat.report else {
        return Text::default();
    };
    let trainee = report.trainee.as_str();
    let flown = match &report.flight {
        Some(flight) => flight.mission.as_ref(),
        None => return joined(trainee, text!("class-home")),
    };
    let mission = flown.map(|id| Text::verbatim(id.as_str()));
    joined(trainee, mission.unwrap_or_else(|| text!("class-free")))
}

fn joined(trainee: &str, flown: Text) -> Text {
    let trainee = Some(Text::verbatim(trainee)).filter(|_| !trainee.is_empty());
    Text::joined(": ", trainee.into_iter().chain([flown]).collect())
}

fn named(name: &str, meaning: Text) -> Named {
    Named {
        name: name.to_owned(),
        meaning,
    }
}
