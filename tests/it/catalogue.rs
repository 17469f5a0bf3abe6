//! The shipped missions: the reference pilot passes each, the naive pilot earns no medal, and doing nothing never
//! passes.
//!
//! The drills and the missions of [`QUICK`] are flown here with one seed, in every build. `sortie check --fly`, in
//! `.ci/run`, flies all of them over several seeds.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::thread;

use sortie::exercise::Exercise;
use sortie::language::{Context, Script};
use sortie::mission::record::{Occasion, Stored, WithoutEnd};
use sortie::mission::{Mission, Report, Skill};
use sortie::scoring::{FlightBackend, Medal};

/// The maximum number of points for a flight without any command.
const IDLE_AT_MOST: u16 = 250;

/// Missions that an unoptimised program flies within a second or two.
const QUICK: [&str; 4] = ["00", "01", "02", "03"];

/// A mission with its pilots.
struct Course {
    name: String,
    mission: Arc<Mission>,
    pilots: BTreeMap<String, String>,
    is_drill: bool,
}

impl Course {
    fn script(&self, source: &str) -> Script {
        let vehicles: Vec<u16> = (1..=self.mission.seats.count as u16).collect();
        let places = self.mission.places_to_name();
        let areas = self.mission.named_areas();
        let context = Context {
            places: Some(&places),
            areas: Some(&areas),
            vehicles: &vehicles,
            ..Context::default()
        };
        Script::parse(source, &context)
            .unwrap_or_else(|faults| panic!("{}: {faults:#?}", self.name))
    }

    fn reference(&self) -> Script {
        let source = self.pilots.get(&self.name);
        self.script(source.unwrap_or_else(|| panic!("{} has no reference pilot", self.name)))
    }

    fn naive(&self) -> Script {
        let name = format!("{}-naive", number(&self.name));
        let source = self.pilots.get(&name);
        self.script(source.unwrap_or_else(|| panic!("there is no {name}.pilot")))
    }

    fn fly(&self, script: &Script, seed: u64) -> Report {
        let mission = Arc::clone(&self.mission);
        let mut exercise = Exercise::new(mission, seed, script.clone(), Vec::new());
        let flight = exercise.flight_mut();
        flight.start_record(&Occasion {
            backend: FlightBackend::Embedded,
            ..Occasion::default()
        });
        while !exercise.is_over() {
            exercise.step();
        }
        let report = exercise.close();
        self.rescore(&report, &exercise.flight_mut().take_record());
        report
    }

    /// Scores a flight again from its record, and checks that the result is identical.
    fn rescore(&self, report: &Report, record: &str) {
        let again = Stored::read(record).and_then(|stored| stored.rescore(WithoutEnd::Over));
        let again = again.unwrap_or_else(|fault| panic!("{}: {fault}", self.name));
        let json = |report: &Report| serde_json::to_string(report).expect("plain data");
        assert_eq!(json(&again.report), json(report), "{}", self.name);
    }
}

fn number(name: &str) -> &str {
    name.split('-').next().unwrap_or(name)
}

fn files(folder: &str, ending: &str) -> BTreeMap<String, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let paths = entries.map(|entry| entry.expect("readable").path());
    let wanted = paths.filter(|path: &PathBuf| path.extension().is_some_and(|it| it == ending));
    wanted
        .map(|path| {
            let stem = path.file_stem().expect("a file").to_string_lossy();
            (
                stem.into_owned(),
                std::fs::read_to_string(&path).expect("text"),
            )
        })
        .collect()
}

/// All missions, in the order of their numbers.
fn courses() -> Vec<Course> {
    let pilots = files("missions/pilots", "pilot");
    let mut courses = Vec::new();
    for (folder, is_drill) in [("missions", false), ("missions/drills", true)] {
        for (name, source) in files(folder, "toml") {
            let mission =
                Mission::parse(&source).unwrap_or_else(|faults| panic!("{name}: {faults:#?}"));
            courses.push(Course {
                name,
                mission: Arc::new(mission),
                pilots: pilots.clone(),
                is_drill,
            });
        }
    }
    courses
}

/// The missions that are flown here.
fn flown() -> Vec<Course> {
    let is_flown = |course: &Course| course.is_drill || QUICK.contains(&number(&course.name));
    courses().into_iter().filter(is_flown).collect()
}

fn for_each(courses: Vec<Course>, check: impl Fn(&Course) + Sync) {
    let left = Mutex::new(courses);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let next = left.lock().expect("nobody has panicked").pop();
                    let Some(course) = next else { break };
                    check(&course);
                }
            });
        }
    });
}

fn told(course: &Course, report: &Report) -> String {
    let locale = sortie::text::Locale::default();
    format!(
        "{}\n{}",
        course.name,
        sortie::debrief::text(report, &locale)
    )
}

#[test]
fn every_mission_speaks_both_languages_and_has_its_pilots() {
    let courses = courses();
    let ids: Vec<&str> = courses.iter().map(|course| course.name.as_str()).collect();
    for course in &courses {
        let mission = &course.mission;
        assert_eq!(course.name, mission.id);
        assert!(
            mission.file.untranslated.is_empty(),
            "{}: {:?}",
            course.name,
            mission.file.untranslated
        );
        course.reference();
        if !course.is_drill {
            course.naive();
            let drill = format!("d{}-", number(&course.name));
            assert!(
                ids.iter().any(|id| id.starts_with(&drill)),
                "{} has no drill",
                course.name
            );
        }
    }
    for pilot in courses[0].pilots.keys() {
        let wanted = ids.contains(&pilot.as_str()) || pilot.ends_with("-naive");
        assert!(wanted, "{pilot}.pilot flies no mission");
    }
}

#[test]
fn missions_about_plans_train_the_skill_of_plans() {
    let trains = |course: &Course| {
        let mut skills = course.mission.objective_skills();
        skills.any(|(_, skill)| skill == Some(Skill::K13))
    };
    let all = courses();
    let training = all.iter().filter(|course| trains(course));
    let names: Vec<&str> = training.map(|course| number(&course.name)).collect();
    assert_eq!(names, ["15", "16", "d15", "d16"]);
}

#[test]
fn the_reference_pilot_earns_silver_and_the_same_again() {
    for_each(flown(), |course| {
        let script = course.reference();
        let report = course.fly(&script, 1);
        assert!(report.passed, "{}", told(course, &report));
        assert!(
            report.medal >= Some(Medal::Silver),
            "{}",
            told(course, &report)
        );
        if number(&course.name) == "00" {
            let json = |report: &Report| serde_json::to_string(report).expect("plain data");
            assert_eq!(
                json(&report),
                json(&course.fly(&script, 1)),
                "{}",
                course.name
            );
        }
    });
}

#[test]
fn the_naive_pilot_earns_no_medal() {
    for_each(flown(), |course| {
        if course.is_drill {
            return;
        }
        let report = course.fly(&course.naive(), 1);
        assert_eq!(report.medal, None, "{}", told(course, &report));
    });
}

#[test]
fn doing_nothing_pays_nothing() {
    for_each(flown(), |course| {
        let report = course.fly(&course.script(""), 1);
        assert!(
            !report.passed && report.medal.is_none() && report.score <= IDLE_AT_MOST,
            "{}",
            told(course, &report)
        );
    });
}

/// The layout before the takeoff, which the seed determines: hazards, gates, zones.
fn layout(course: &Course, seed: u64) -> String {
    let mission = Arc::clone(&course.mission);
    let mut exercise = Exercise::new(mission, seed, course.script(""), Vec::new());
    let progress = exercise.flight_mut().progress();
    let truth = serde_json::to_string(&exercise.report().truth).expect("plain data");
    format!("{truth} {:?} {:?}", progress.places, progress.areas)
}

#[test]
fn each_seed_lays_a_mission_out_in_its_own_way() {
    for course in courses().iter().filter(|course| !course.is_drill) {
        let layouts: BTreeSet<String> = (1..=5).map(|seed| layout(course, seed)).collect();
        assert_eq!(layouts.len(), 5, "{}", course.name);
        assert_eq!(layout(course, 1), layout(course, 1), "{}", course.name);
    }
}
