mod hostile;
mod imported;
mod read_only;
mod rescue;

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::sync::Arc;

use proptest::prelude::*;
use proptest::sample::select;

use super::{Profile, ProfileError, ProfileFile, ProfileSettings, Profiles, RunEntry};
use crate::campaign::{
    Aids, CareerEntry, CareerFlight, CareerStanding, MissionCourse, Offer, PurchaseRefusal, Stake,
};
use crate::exercise::Exercise;
use crate::language::{Context, Script};
use crate::mission::{Mission, Requires};
use crate::scoring::{Medal, Report};
use crate::text::Text;
use crate::workshop::{Design, part};

const WHEN: &str = "2026-11-20T14:03:22Z";

fn open(data: &Path) -> Profiles {
    let (profiles, rescue) = Profiles::open(data).expect("a folder of our own");
    assert_eq!(rescue, None);
    profiles
}

/// The report of a flight that has not begun.
fn report() -> Report {
    let mission = include_str!("../../../missions/00-first-flight.toml");
    let mission = Mission::parse(mission).expect("no faults");
    let script = Script::parse("", &Context::default()).expect("nothing to do");
    Exercise::new(Arc::new(mission), 1, script, Vec::new()).report()
}

fn run(id: &str, mission: &str, score: u16) -> RunEntry {
    run_with(report(), id, mission, score)
}

fn run_with(report: Report, id: &str, mission: &str, score: u16) -> RunEntry {
    let report = Report {
        mission: mission.to_owned(),
        score,
        ..report
    };
    RunEntry {
        id: id.to_owned(),
        when: WHEN.to_owned(),
        flight: CareerFlight {
            flown_by: None,
            mission: mission.to_owned(),
            drill_of: None,
            tier: 1,
            reward: 400,
            vehicles: 1,
            stake: Stake::Graded,
            day: 20_000,
            score,
            passed: score >= 550,
            medal: (score >= 700).then_some(Medal::Silver),
            evidence: Vec::new(),
            wear: 0,
            imported: false,
        },
        report,
        airframes: vec!["schema = 1\n".to_owned()],
        recording: Some(format!("{id}.run.jsonl")),
    }
}

fn course() -> MissionCourse {
    MissionCourse::new([Offer {
        id: "one".to_owned(),
        title: Text::verbatim("one"),
        tier: 1,
        vehicles: 1,
        drill_of: None,
        requires: Requires::default(),
        credits: 400,
        kinds: Vec::new(),
        parts: vec!["s_gpr".to_owned()],
        skills: Vec::new(),
        objectives: BTreeMap::new(),
    }])
}

fn anna(profiles: &Profiles) -> Profile {
    profiles.create("Anna", WHEN).expect("a new one")
}

#[test]
fn a_profile_is_found_by_its_name_in_any_case_and_made_once() {
    let data = tempfile::tempdir().expect("a folder");
    let profiles = open(data.path());
    let anna = anna(&profiles);
    assert_eq!(profiles.find("ANNA").expect("there"), anna);
    assert!(matches!(
        profiles.create("anna", WHEN),
        Err(ProfileError::Exists { .. })
    ));
    let unknown = profiles.find("Borys").expect_err("no such profile");
    assert!(unknown.to_string().contains("Anna"), "{unknown}");
    for name in ["", "  ", "two\nlines", &"x".repeat(41)] {
        assert!(
            matches!(profiles.create(name, WHEN), Err(ProfileError::Name)),
            "{name:?}"
        );
    }
    let settings = ProfileSettings {
        lang: Some("uk".to_owned()),
        aids: Aids::None,
        ..anna.settings.clone()
    };
    profiles.set_settings(&anna, &settings).expect("stored");
    assert_eq!(profiles.find("Anna").expect("there").settings, settings);
    profiles.delete(&anna).expect("gone");
    assert_eq!(profiles.list().expect("readable"), []);
}

#[test]
fn who_holds_a_removed_profile_writes_into_nobody_elses() {
    let data = tempfile::tempdir().expect("a folder");
    let (mut one, two) = (open(data.path()), open(data.path()));
    let gone = anna(&one);
    two.delete(&gone).expect("gone");
    let borys = two.create("Borys", WHEN).expect("a new one");
    one.store(&gone, &run("a", "one", 800))
        .expect_err("whose is it");
    one.keep_design(&gone, &Design::new("Scout"))
        .expect_err("whose is it");
    assert_eq!(two.history(&borys).expect("readable"), []);
    assert_eq!(two.designs(&borys).expect("readable"), []);
}

#[test]
fn only_its_owner_reads_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = folder.path().join("new");
    let profiles = open(&data);
    anna(&profiles);
    for file in fs::read_dir(&data).expect("made").flatten() {
        let mode = file.metadata().expect("there").permissions().mode() & 0o777;
        assert_eq!(mode, 0o600, "{:?}", file.file_name());
    }
    let mode = fs::metadata(&data).expect("made").permissions().mode() & 0o777;
    assert_eq!(mode, 0o700);
}

#[test]
fn a_run_counts_once_however_often_it_is_handed_in() {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let anna = anna(&profiles);
    assert!(
        profiles
            .store(&anna, &run("a", "one", 800))
            .expect("stored")
    );
    assert!(
        !profiles
            .store(&anna, &run("a", "one", 1000))
            .expect("known")
    );
    assert!(
        profiles
            .store(&anna, &run("b", "two", 600))
            .expect("stored")
    );
    let history = profiles.history(&anna).expect("readable");
    assert_eq!(
        history,
        ["a", "b"].map(|id| {
            let (mission, score) = if id == "a" {
                ("one", 800)
            } else {
                ("two", 600)
            };
            CareerEntry::Flight(run(id, mission, score).flight)
        })
    );
    let exported = profiles.export(&anna).expect("readable").write();
    let exported: serde_json::Value = serde_json::from_str(&exported).expect("just written");
    // Texts are stored in English.
    let report = serde_json::to_value(run("a", "one", 800).report).expect("plain");
    assert_eq!(exported["runs"][0]["report"], report);
    assert_eq!(exported["runs"][1]["report"]["mission"], "two");
}

#[test]
fn what_one_console_stores_another_sees_and_credits_are_spent_once() {
    let data = tempfile::tempdir().expect("a folder");
    let (mut one, mut two) = (open(data.path()), open(data.path()));
    let anna = anna(&one);
    one.store(&anna, &run("a", "one", 1000)).expect("stored");
    let credits = || CareerStanding::of(&two.history(&anna).expect("readable")).credits();
    assert_eq!(credits(), 900);
    // The licence for a mesh radio costs 404 credits.
    one.buy(&anna, "r_mesh24", &course(), WHEN).expect("paid");
    assert!(matches!(
        two.buy(&anna, "r_mesh24", &course(), WHEN),
        Err(ProfileError::Refused(PurchaseRefusal::Owned))
    ));
    assert!(matches!(
        two.buy(&anna, "gps_crpa", &course(), WHEN),
        Ok(purchase) if purchase.credits == 474
    ));
    assert!(matches!(
        one.buy(&anna, "fc_cube", &course(), WHEN),
        Err(ProfileError::Refused(PurchaseRefusal::TooDear(152, 22)))
    ));
}

#[test]
fn a_profile_that_is_exported_and_imported_is_the_same() {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let anna = anna(&profiles);
    profiles
        .store(&anna, &run("a", "one", 800))
        .expect("stored");
    profiles
        .buy(&anna, "r_rfd900", &course(), WHEN)
        .expect("paid");
    let design = Design::new("Scout").with(part("fr_5q_226").expect("known"));
    profiles.keep_design(&anna, &design).expect("kept");
    let exported = profiles.export(&anna).expect("readable");
    let read = ProfileFile::read(&exported.write()).expect("just written");
    assert_eq!(read, exported);
    assert!(matches!(
        profiles.import(&read, "anna"),
        Err(ProfileError::Exists { .. })
    ));
    let copy = profiles.import(&read, "Copy").expect("free");
    let again = profiles.export(&copy).expect("readable");
    assert_eq!(again.write(), exported.write().replacen("Anna", "Copy", 1));
    assert_eq!(profiles.designs(&copy).expect("readable"), [design]);
    for broken in [
        "",
        "{}",
        "[1]",
        &exported
            .write()
            .replacen("\"sortie_profile\": 1", "\"sortie_profile\": 9", 1),
    ] {
        assert!(matches!(
            ProfileFile::read(broken),
            Err(ProfileError::NoProfile { .. })
        ));
    }
}

#[test]
fn a_renamed_design_is_there_once_even_where_only_the_case_changes() {
    let data = tempfile::tempdir().expect("a folder");
    let profiles = open(data.path());
    let anna = anna(&profiles);
    profiles
        .keep_design(&anna, &Design::new("Scout"))
        .expect("kept");
    for (from, to) in [("Scout", "SCOUT"), ("scout", "Їжак"), ("Їжак", "Їжак")] {
        let renamed = Design::new(to);
        profiles
            .rename_design(&anna, from, &renamed)
            .expect("renamed");
        assert_eq!(profiles.designs(&anna).expect("readable"), [renamed]);
    }
}

#[test]
fn a_design_whose_renaming_fails_keeps_its_old_name() {
    let data = tempfile::tempdir().expect("a folder");
    let profiles = open(data.path());
    let anna = anna(&profiles);
    let scout = Design::new("Scout");
    profiles.keep_design(&anna, &scout).expect("kept");
    let full = "CREATE TEMP TRIGGER full BEFORE INSERT ON main.designs BEGIN SELECT RAISE(ABORT, 'full'); END";
    profiles.connection.execute_batch(full).expect("armed");
    profiles
        .rename_design(&anna, "Scout", &Design::new("Raven"))
        .expect_err("no room");
    assert_eq!(profiles.designs(&anna).expect("readable"), [scout]);
}

#[test]
fn a_database_of_a_newer_version_is_left_as_it_is() {
    let data = tempfile::tempdir().expect("a folder");
    let file = data.path().join("profiles.sqlite");
    {
        let profiles = open(data.path());
        anna(&profiles);
        let newer = profiles
            .connection
            .execute_batch("PRAGMA user_version = 99");
        newer.expect("writable");
    }
    let before = fs::read(&file).expect("readable");
    let refused = Profiles::open(data.path()).expect_err("newer");
    assert!(refused.to_string().contains("99"), "{refused}");
    assert_eq!(fs::read(&file).expect("readable"), before);
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = folder.path().join("file");
    fs::write(&data, "no folder").expect("writable");
    let refused = Profiles::open(&data).expect_err("no folder");
    assert!(refused.to_string().contains("profiles.sqlite"), "{refused}");
}

#[derive(Debug, Clone)]
enum Deed {
    Fly(u8, u16, u32),
    Buy(&'static str),
    Keep(&'static str),
}

fn any_deed() -> impl Strategy<Value = Deed> {
    let parts = vec!["r_rfd900", "s_gpr", "gps_crpa", "no_such_part", "fc_h7"];
    let names = vec!["Scout", "scout", "Їжак", "a,b\"c"];
    prop_oneof![
        (0u8..6, 0u16..=1000, 0u32..900).prop_map(|(id, score, wear)| Deed::Fly(id, score, wear)),
        select(parts).prop_map(Deed::Buy),
        select(names).prop_map(Deed::Keep),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn whatever_is_done_runs_count_once_and_an_export_is_the_whole_profile(deeds in proptest::collection::vec(any_deed(), 0..14)) {
        let data = tempfile::tempdir().expect("a folder");
        let mut profiles = open(data.path());
        let anna = anna(&profiles);
        let report = report();
        let mut flown = std::collections::BTreeSet::new();
        for deed in &deeds {
            match deed {
                Deed::Fly(id, score, wear) => {
                    let flown_before = flown.contains(id);
                    let mut run = run_with(report.clone(), &id.to_string(), "one", *score);
                    run.flight.wear = *wear;
                    let is_new = profiles.store(&anna, &run).expect("stored");
                    prop_assert_eq!(is_new, !flown_before);
                    flown.insert(*id);
                }
                Deed::Buy(part) => {
                    let before = CareerStanding::of(&profiles.history(&anna).expect("readable")).credits();
                    let bought = profiles.buy(&anna, part, &course(), WHEN);
                    let after = CareerStanding::of(&profiles.history(&anna).expect("readable")).credits();
                    let paid = bought.map_or(0, |purchase| purchase.credits);
                    prop_assert_eq!(before - after, paid, "what was bought is paid, and nothing else");
                }
                Deed::Keep(name) => {
                    let design = Design::new(*name).with(part("fr_5q_226").expect("known"));
                    profiles.keep_design(&anna, &design).expect("kept");
                }
            }
        }
        prop_assert_eq!(profiles.runs(&anna).expect("readable").len(), flown.len());
        let exported = profiles.export(&anna).expect("readable");
        let read = ProfileFile::read(&exported.write()).expect("just written");
        let copy = profiles.import(&read, "Copy").expect("free");
        let again = profiles.export(&copy).expect("readable");
        prop_assert_eq!(again.write(), exported.write().replacen("Anna", "Copy", 1));
        prop_assert_eq!(profiles.history(&copy).expect("readable"), profiles.history(&anna).expect("readable"));
    }
}
