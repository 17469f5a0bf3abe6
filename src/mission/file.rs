//! A mission file: its sections in the order in which they may refer to one another. Every section is read separately,
//! so that one fault does not hide the others.
//!
//! # How the parts fit
//! - What is flown, and where: `head`, `site`, `fleet`, `board` (plans on board), `places`, `zones`, `radio`.
//! - What counts: `objectives`, `rules`, `score`, `career` (requirements and rewards).
//! - What happens and what is said: `events` with their `condition`s and `action`s, `advice`, `lesson`.
//! - Who flies it: `crew`.

use toml::de::DeTable;

use super::board::BoardSetup;
use super::event::Event;
use super::event::standard::Standard;
use super::format::{self, Draft, FileTable, NameKind, WrittenValue, describe, table, tables};
use super::hazard::{self, Hazard};
use super::radio::Radio;
use super::weather::Weather;
use super::{
    CareerTerms, FlightRules, LessonStep, Mission, MissionAdvice, MissionSeats, MissionSite,
    MissionSource, Origin, Point,
};
use crate::crew::Post;
use crate::diagnostic::Diagnostic;
use crate::scoring::ScoreRules;
use crate::text;

mod action;
mod advice;
mod board;
mod career;
mod condition;
mod crew;
mod events;
mod fleet;
mod head;
mod lesson;
mod objectives;
mod places;
mod radio;
mod rules;
mod score;
mod site;
mod zones;

use fleet::FleetSection;
use head::FileHead;
use site::SiteSection;

/// The maximum number of zones, places, events or hints of one mission.
const MOST_TABLES: usize = 200;
/// The maximum number of hazards, each of which may have tens of thousands of cells.
const MOST_HAZARDS: usize = 20;
/// The maximum number of objectives, each of which may have as many cells as a hazard.
const MOST_OBJECTIVES: usize = 50;

/// The maximum number of members of a crew.
const MOST_POSTS: usize = 16;

/// Reads a mission file.
pub(super) fn read(source: &str) -> Result<Mission, Vec<Diagnostic>> {
    let root = DeTable::parse(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
    let mut draft = Draft::of(root.get_ref());
    let written = WrittenValue::of_file(&root);
    let mission = FileTable::read_root(mission, root, &mut draft);
    let mut faults = draft.faults;
    match mission {
        Some(mission) if faults.is_empty() => Ok(Mission {
            file: MissionSource {
                text: source.to_owned(),
                written,
                untranslated: faults.take_untranslated(),
            },
            ..mission
        }),
        _ if faults.is_empty() => Err(vec![Diagnostic::new(0..0, text!("fault-no-mission"))]),
        _ => Err(faults.sorted()),
    }
}

/// The JSON schema of mission files, for editors.
pub fn schema() -> String {
    format::schema(&describe(mission))
}

/// The reference of mission files in Markdown.
pub fn reference() -> String {
    format::reference(&describe(mission))
}

/// All sections; `None` if a required one could not be read.
fn mission(file: &mut FileTable<'_>) -> Option<Mission> {
    let head = FileHead::need(file);
    let setting = MissionSetting::need(file);
    let content = MissionContent::of(file);
    let course = MissionCourse::of(file);
    let worth = MissionWorth::need(file);
    let (head, setting, worth) = (head?, setting?, worth?);
    Some(Mission {
        id: head.id,
        rev: head.rev,
        title: head.title,
        file: MissionSource::default(),
        summary: head.summary,
        career: worth.career,
        rules: setting.rules,
        advice: MissionAdvice {
            lesson: course.lesson,
            ..content.advice
        },
        scoring: worth.scoring,
        site: MissionSite {
            origin: setting.origin,
            weather: setting.weather,
            zones: file.draft().zones.clone(),
            places: content.places,
            hazards: content.hazards,
            hazard_ids: file.draft().ids("hazards").to_vec(),
            radio: course.radio,
        },
        seats: MissionSeats {
            crew: course.crew,
            ..setting.fleet.seats()
        },
        board: content.board,
        objectives: content.objectives,
        events: course.events,
        may_inject: course.may_inject,
    })
}

/// The sections for the site, the fleet and the rules.
struct MissionSetting {
    origin: Origin,
    weather: Weather,
    fleet: FleetSection,
    rules: FlightRules,
}

impl MissionSetting {
    fn need(file: &mut FileTable<'_>) -> Option<Self> {
        let site = file.need("sim", table(site::site), "place and duration of the flight");
        let weather = file.may(
            "weather",
            table(site::weather),
            "weather; by default calm, 20 degrees Celsius and daylight. The wind moves the vehicles, the clouds and the fires",
        );
        let fleet = file.need(
            "fleet",
            table(fleet::fleet),
            "the vehicles, their sensors and their loads",
        );
        if let Some(fleet) = &fleet {
            file.draft().pads.clone_from(&fleet.pads);
            file.draft().sensors = fleet.sensors();
        }
        let rules = file.may(
            "rules",
            table(rules::rules),
            "rules that all vehicles must follow",
        );
        let SiteSection { time_limit, origin } = site?;
        Some(Self {
            origin,
            weather: weather.unwrap_or(Weather::CALM),
            fleet: fleet?,
            rules: FlightRules {
                time_limit,
                ..rules.unwrap_or_else(rules::usual)
            },
        })
    }
}

/// The sections for zones, places, plans on board, hazards and objectives.
struct MissionContent {
    board: BoardSetup,
    places: Vec<(String, Point)>,
    hazards: Vec<Box<dyn Hazard>>,
    objectives: Vec<super::objective::Objective>,
    advice: MissionAdvice,
}

impl MissionContent {
    fn of(file: &mut FileTable<'_>) -> Self {
        let zones_form = tables(zones::zone, MOST_TABLES);
        let zones = file
            .may("zones", zones_form, "areas with a special meaning")
            .unwrap_or_default();
        file.draft().zones = zones;
        let places_form = tables(places::place, MOST_TABLES);
        let places = file.may(
            "places",
            places_form,
            "named points for commands and objectives",
        );
        file.draft().places = places.unwrap_or_default();
        let board = file.may(
            "board",
            table(board::board),
            "the plans and the fence that the vehicles carry at the start; without this table, none",
        );
        let board = board.unwrap_or_default();
        file.draft().has_plans = !board.routes.is_empty();
        let hazards_form = tables(hazard, MOST_HAZARDS);
        let hazards = file.may(
            "hazards",
            hazards_form,
            "the hazards. Random values are drawn from the seed of the flight: the same seed gives the same world. \
             `jitter` sets how far a position varies, so that trainees cannot learn it by heart",
        );
        let objectives_form = tables(objectives::objective, MOST_OBJECTIVES);
        let objectives = file.need("objectives", objectives_form, "goals for the trainee");
        objectives::check(file, objectives.as_deref());
        places::check_no_cells(file.draft());
        let hints = file.may(
            "hints",
            tables(advice::advice, MOST_TABLES),
            "hints for the trainee",
        );
        let places = file.draft().places.iter();
        Self {
            board,
            places: places.map(|place| (place.name.clone(), place.at)).collect(),
            hazards: hazards.unwrap_or_default(),
            objectives: objectives.unwrap_or_default(),
            advice: advice::of(hints.unwrap_or_default()),
        }
    }
}

/// The sections for events, advice, the lesson and the crew.
struct MissionCourse {
    radio: Option<Radio>,
    events: Vec<Event>,
    may_inject: Vec<Standard>,
    lesson: Vec<LessonStep>,
    crew: Vec<Post>,
}

impl MissionCourse {
    fn of(file: &mut FileTable<'_>) -> Self {
        let radio = file.may(
            "radio",
            table(radio::radio),
            "radio range. Without this table, the mission's own drones have unlimited range; drones from the workshop \
             always have the range of their own radios",
        );
        let events = file.may(
            "events",
            tables(events::event, MOST_TABLES),
            "events during the mission",
        );
        let may_inject = file.may(
            "instructor",
            table(radio::may_inject),
            "threats that an instructor may trigger in addition to events with `by = \"instructor\"`",
        );
        let lesson = file.may(
            "lesson",
            tables(lesson::step, MOST_TABLES),
            "steps that guide a trainee through the first flights; not shown in exams, after the mission has been passed, \
             or when advice is switched off",
        );
        let crew = file.may(
            "crew",
            tables(crew::post, MOST_POSTS),
            "the places of a crew that flies the mission together; without these tables, the mission is meant for one \
             person. The host of the crew flies every vehicle that no other member flies",
        );
        Self {
            radio,
            events: events.unwrap_or_default(),
            may_inject: may_inject.unwrap_or_default(),
            lesson: lesson.unwrap_or_default(),
            crew: crew::checked(file, crew.unwrap_or_default()),
        }
    }
}

/// The sections for scoring, rewards and requirements.
struct MissionWorth {
    scoring: ScoreRules,
    career: CareerTerms,
}

impl MissionWorth {
    fn need(file: &mut FileTable<'_>) -> Option<Self> {
        let scoring = file.need("scoring", table(score::rules), "how the flight is scored");
        let requires = file.may(
            "requires",
            table(career::requires),
            "requirements for starting the mission",
        );
        let rewards = file.may(
            "rewards",
            table(career::rewards),
            "rewards for passing the mission",
        );
        Some(Self {
            scoring: scoring?,
            career: CareerTerms {
                requires: requires.unwrap_or_default(),
                rewards: rewards.unwrap_or_default(),
            },
        })
    }
}

fn hazard(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    table.need_id("hazards");
    let (_, hazard) = table.need_kind(NameKind::HazardKind, hazard::KINDS)?;
    Some(hazard)
}

#[cfg(test)]
mod tests;
