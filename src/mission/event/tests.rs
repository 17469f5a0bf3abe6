//! Events and their effect on a flying vehicle.

use crate::mission::Mission;
use crate::mission::fake::Pilot;
use crate::scoring::{FlightOutcome, Report, SafetyKind};
use crate::session::{RadioFault, Want};

mod injects;

/// The first mission with more text appended.
fn mission(more: &str) -> Result<Mission, Vec<crate::diagnostic::Diagnostic>> {
    let file = include_str!("../../../missions/01-air-sample.toml");
    Mission::parse(&format!("{file}\n{more}"))
}

fn pilot(more: &str, seed: u64) -> Pilot {
    Pilot::flying(mission(more).expect("a good mission"), seed)
}

/// The times of the notices with a text, in seconds.
fn said(report: &Report, text: &str) -> Vec<f64> {
    let events = report.events.iter();
    let said = events.filter(|event| event.text == *text);
    said.map(|event| event.at_s).collect()
}

/// The values demanded for a parameter, in order.
fn demanded(pilot: &mut Pilot, parameter: &str) -> Vec<f64> {
    let demands = pilot.flight.take_demands().into_iter();
    let values = demands.filter_map(|demand| match demand.want {
        Want::Parameter { name, value } if name == parameter => Some(value),
        _ => None,
    });
    values.collect()
}

#[test]
fn the_seed_decides_when_an_event_happens_and_whether() {
    let event = "[[events]]\nid = 'e'\nat = 20\njitter = 5\np = 0.5\ndo = [{ say = 'now' }]";
    let mut times = Vec::new();
    for seed in 0..60 {
        let mut pilot = pilot(event, seed);
        pilot.wait(30.0);
        let said = said(&pilot.report(), "now");
        assert!(said.len() <= 1);
        times.extend(said);
    }
    // The mean is 30 of 60, with a standard deviation of 3.9.
    assert!((14..=46).contains(&times.len()), "{}", times.len());
    assert!(
        times.iter().all(|at| (15.0..=25.1).contains(at)),
        "{times:?}"
    );
    let spread = times
        .iter()
        .fold(0.0f64, |most, at| most.max((at - times[0]).abs()));
    assert!(spread > 2.0, "{times:?}");
    let again = |seed| {
        let mut pilot = pilot(event, seed);
        pilot.wait(30.0);
        said(&pilot.report(), "now")
    };
    assert_eq!(again(7), again(7));
}

#[test]
fn conditions_start_events_when_they_begin_to_hold() {
    let events = "
        [[events]]\nid = 'up'\nwhen = 'agl_min() < 100 and vehicle(1).z > 10'\ndo = [{ say = 'once' }]
        [[events]]\nid = 'each'\nwhen = 'vehicle(1).z > 10'\nonce = false\ndo = [{ say = 'each' }]
        [[events]]\nid = 'then'\nafter = 'up'\ndelay = 3\ndo = [{ say = 'then' }, { event = 'last' }]
        [[events]]\nid = 'last'\nby = 'instructor'\ndo = [{ say = 'last' }]";
    let mut pilot = pilot(events, 1);
    pilot.take_off(20.0);
    pilot.wait(5.0);
    pilot.land();
    pilot.take_off(20.0);
    let report = pilot.report();
    let (once, each) = (said(&report, "once"), said(&report, "each"));
    assert_eq!((once.len(), each.len()), (1, 2), "{once:?} {each:?}");
    assert!((once[0] - each[0]).abs() < 1e-9);
    let then = said(&report, "then")[0] - once[0];
    assert!((2.9..=3.2).contains(&then), "{then}");
    assert_eq!(said(&report, "last").len(), 1);
}

#[test]
fn alerts_are_answered_by_what_happens() {
    let events = "
        [[events]]\nid = 'climb'\nat = 1\ndo = [{ alert = 'critical', text = 'climb', ok = 'vehicle(1).z > 15', within = 20 }]
        [[events]]\nid = 'never'\nat = 1\ndo = [{ alert = 'caution', text = 'far', ok = 'vehicle(1).x > 1e6' }]
        [[events]]\nid = 'told'\nat = 1\ndo = [{ alert = 'warning', text = 'told' }]";
    let mut pilot = pilot(events, 1);
    pilot.wait(2.0);
    let open = pilot.flight.progress().alerts;
    let words: Vec<String> = open.iter().map(|alert| alert.text.to_string()).collect();
    assert_eq!(words, ["climb", "far"]);
    assert!(open[0].remaining.as_secs() >= 18, "{:?}", open[0].remaining);
    pilot.take_off(20.0);
    let facts = pilot.flight.alert_facts();
    assert_eq!(facts.len(), 2);
    let after_s = facts[0]
        .answered_after
        .expect("it was answered")
        .as_secs_f64();
    assert!((8.0..=20.0).contains(&after_s), "{after_s}");
    assert_eq!(facts[1].answered_after, None);
    assert_eq!(pilot.flight.progress().alerts.len(), 1);
}

#[test]
fn wind_changes_little_by_little_and_goes_back() {
    let event = "[[events]]\nid = 'gust'\nat = 2\ndo = [{ set = 'weather.wind.speed', to = 11, ramp = 4, for = 10 }]";
    let mut pilot = pilot(event, 1);
    pilot.wait(30.0);
    let speeds = demanded(&mut pilot, "SIM_WIND_SPD");
    let most = speeds.iter().copied().fold(0.0, f64::max);
    assert!(
        (speeds[0] - 3.0).abs() < 1e-9 && (most - 11.0).abs() < 1e-9,
        "{speeds:?}"
    );
    assert!(
        speeds.len() > 10 && (speeds.last().expect("some") - 3.0).abs() < 0.11,
        "{speeds:?}"
    );
}

#[test]
fn a_jammed_zone_takes_hold_at_its_border_and_lets_go_beyond_it() {
    let zone = "
        [[zones]]\nid = 'jam'\nkind = 'gnss_jam'\ncenter = [0, 60]\nradius = 20\nedge = 20\nactive = false
        [[events]]\nid = 'on'\nat = 30\ndo = [{ zone = 'jam', active = true }]";
    let mut pilot = pilot(zone, 1);
    pilot.take_off(20.0);
    pilot.goto(60.0, 0.0, 10.0);
    assert!(demanded(&mut pilot, "SIM_GPS_DISABLE").is_empty());
    assert_eq!(pilot.flight.progress().areas.len(), 2);
    pilot.wait(20.0);
    assert_eq!(demanded(&mut pilot, "SIM_GPS_DISABLE"), [1.0]);
    assert_eq!(pilot.flight.progress().areas.len(), 3);
    pilot.goto(84.0, 0.0, 10.0);
    pilot.wait(1.0);
    assert!(demanded(&mut pilot, "SIM_GPS_DISABLE").is_empty());
    pilot.goto(88.0, 0.0, 10.0);
    pilot.wait(1.0);
    let demands = pilot.flight.take_demands();
    let all: Vec<(&str, f64)> = demands
        .iter()
        .filter_map(|demand| match demand.want {
            Want::Parameter { name, value } => Some((name, value)),
            Want::Radio(_) | Want::RadioTest(_) | Want::Lists(_) => None,
        })
        .collect();
    assert!(all.contains(&("SIM_GPS_DISABLE", 0.0)), "{all:?}");
    assert!(all.contains(&("SIM_GPS_NUMSATS", 7.0)), "{all:?}");
    pilot.goto(110.0, 0.0, 10.0);
    pilot.wait(1.0);
    assert_eq!(demanded(&mut pilot, "SIM_GPS_NUMSATS").last(), Some(&10.0));
}

#[test]
fn what_breaks_is_mended_after_its_time() {
    let events = "
        [[events]]\nid = 'motor'\nat = 1\ndo = [{ fault = 'motor', vehicle = 1, to = 0.6, for = 5 }]
        [[events]]\nid = 'cell'\nat = 1\ndo = [{ fault = 'battery', vehicle = 'all', to = 0.8 }]
        [[events]]\nid = 'silence'\nat = 1\ndo = [{ fault = 'link', vehicle = 'random', for = 5 }]";
    let mut pilot = pilot(events, 1);
    pilot.wait(10.0);
    let demands = pilot.flight.take_demands();
    let values = |wanted: &str| -> Vec<f64> {
        let values = demands.iter().filter_map(|demand| match demand.want {
            Want::Parameter { name, value } if name == wanted => Some(value),
            _ => None,
        });
        values.collect()
    };
    assert_eq!(values("SIM_ENGINE_MUL"), [0.6, 1.0]);
    let battery = values("SIM_BATT_VOLTAGE");
    assert!(
        battery.len() == 1 && (battery[0] - 12.6 * 0.8).abs() < 1e-3,
        "{battery:?}"
    );
    let cut: Vec<bool> = demands
        .iter()
        .filter_map(|demand| match demand.want {
            Want::Radio(fault) => Some(fault.is_cut()),
            Want::Parameter { .. } | Want::RadioTest(_) | Want::Lists(_) => None,
        })
        .collect();
    assert_eq!(cut, [true, false]);
}

#[test]
fn a_stuck_sensor_shows_what_it_showed() {
    let event = "[[events]]\nid = 'stuck'\nat = 40\ndo = [{ fault = 'sensor_stuck', vehicle = 1 }]";
    let mut pilot = pilot(event, 1);
    pilot.take_off(20.0);
    pilot.goto(60.0, 0.0, 10.0);
    pilot.wait(30.0);
    let shown = |pilot: &Pilot| pilot.flight.progress().readings[0].value;
    let stuck = shown(&pilot);
    pilot.goto(80.0, -30.0, 5.0);
    pilot.wait(5.0);
    assert!((shown(&pilot) - stuck).abs() < 1e-9);
}

#[test]
fn zones_that_appear_have_to_be_left() {
    let zone = "
        [[zones]]\nid = 'school'\nkind = 'no_fly'\ncenter = [0, 60]\nradius = 20\nceiling = 50\nactive = false
        [[events]]\nid = 'on'\nat = 40\ndo = [{ zone = 'school', active = true }]";
    let mut pilot = pilot(zone, 1);
    pilot.take_off(20.0);
    pilot.goto(60.0, 0.0, 10.0);
    let broken = |pilot: &Pilot| -> Vec<SafetyKind> {
        let events = pilot.flight.broken_rules().iter();
        events.map(|event| event.kind).collect()
    };
    assert!(broken(&pilot).is_empty());
    pilot.wait(30.0);
    assert_eq!(broken(&pilot), [SafetyKind::NoFly]);
}

#[test]
fn hurting_somebody_fails_the_mission() {
    let event = "
        [[events]]\nid = 'walker'\nat = 2\ndo = [{ spawn = 'person', path = [[0, 0], [0.5, 0]], speed = 0.1, keep_out = 10 }]";
    let mut pilot = pilot(event, 1);
    pilot.take_off(20.0);
    let report = pilot.report();
    assert_eq!(pilot.flight.outcome(), FlightOutcome::Failed);
    assert!(
        report.score <= 300 && report.medal.is_none(),
        "{}",
        report.score
    );
    let kinds: Vec<SafetyKind> = pilot.flight.broken_rules().iter().map(|e| e.kind).collect();
    assert!(kinds.contains(&SafetyKind::Injury), "{kinds:?}");
}

#[test]
fn faults_of_events_are_told_where_they_are() {
    for (more, says) in [
        (
            "[[events]]\nid = 'e'\ndo = [{ say = 'x' }]",
            "exactly one of `at`",
        ),
        (
            "[[events]]\nid = 'e'\nat = 1\nwhen = 't > 1'\ndo = [{ say = 'x' }]",
            "exactly one of `at`",
        ),
        ("[[events]]\nid = 'e'\nat = 1", "missing field `do`"),
        ("[[events]]\nid = 'e'\nat = 1\ndo = []", "1 to 50 entries"),
        (
            "[[events]]\nid = 'e'\nat = 1\ndo = [{ shout = 'x' }]",
            "an action needs one of",
        ),
        (
            "[[events]]\nid = 'e'\nwhen = 't > inside(\"yrd\")'\ndo = [{ say = 'x' }]",
            "has no meaning here",
        ),
        (
            "[[events]]\nid = 'e'\nwhen = \"inside('yrd') > 0\"\ndo = [{ say = 'x' }]",
            "the id of a zone",
        ),
        (
            "[[events]]\nid = 'e'\nat = 1\ndo = [{ zone = 'yrd', active = true }]",
            "unknown zone `yrd`",
        ),
        (
            "[[events]]\nid = 'e'\nafter = 'f'\ndo = [{ say = 'x' }]",
            "unknown event `f`",
        ),
        (
            "[[events]]\nid = 'e'\nat = 1\ndo = [{ fault = 'wing', vehicle = 1 }]",
            "unknown fault `wing`",
        ),
        (
            "[[events]]\nid = 'e'\nat = 1\ndo = [{ fault = 'motor', vehicle = 2 }]",
            "a number from 1 to 1",
        ),
        (
            "[[events]]\nid = 'e'\nat = 1\ndo = [{ set = 'weather.rain', to = 1 }]",
            "unknown quantity",
        ),
        (
            "[[events]]\nid = 'e'\nat = 1\ndo = [{ spawn = 'horse', path = [[0, 0], [1, 1]], speed = 1 }]",
            "unknown mover",
        ),
        (
            "[[zones]]\nid = 'z'\nkind = 'comm_shadow'\ncenter = [0, 0]\nradius = 5",
            "either the `height`",
        ),
        (
            "[[zones]]\nid = 'z'\nkind = 'no_fly'\ncenter = [0, 0]\nradius = 5\nfloor = 9\nceiling = 3",
            "must lie below",
        ),
        ("[radio]\nmodel = 'r_tin_can'", "unknown radio"),
        (
            "[instructor]\nmay_inject = ['thunder']",
            "unknown threat `thunder`",
        ),
    ] {
        let faults = mission(more).expect_err(more);
        let words = faults[0].message.to_string();
        assert!(words.contains(says), "{more}: {words}");
        assert!(faults[0].span.start > 1000, "{more}: {:?}", faults[0].span);
    }
}

/// The states demanded for the first vehicle's link, in order.
fn links(pilot: &mut Pilot) -> Vec<RadioFault> {
    let demands = pilot.flight.take_demands().into_iter();
    let links = demands.filter_map(|demand| match demand.want {
        Want::Radio(fault) if demand.vehicle == 1 => Some(fault),
        _ => None,
    });
    links.collect()
}

#[test]
fn an_event_takes_a_share_of_a_links_frames_and_gives_it_back() {
    let event = "[[events]]\nid = 'loss'\nat = 2\ndo = [{ fault = 'link', vehicle = 1, to = 0.4, for = 5 }]";
    let mut pilot = pilot(event, 3);
    pilot.wait(10.0);
    let links = links(&mut pilot);
    let losses: Vec<f64> = links.iter().map(|link| link.loss).collect();
    assert_eq!(losses, [0.4, 0.0]);
    assert!(links.iter().all(|link| !link.is_cut() && link.seed == 3));
}

#[test]
fn a_link_gets_late_and_is_cut_with_the_distance_and_in_noise() {
    let far = "
        [radio]\nmodel = 'r_wifi24'\nstation = [0, 0]
        [[zones]]\nid = 'noise'\nkind = 'radio_jam'\ncenter = [0, 60]\nradius = 10\nedge = 5\nnoise = 80\nactive = false
        [[events]]\nid = 'on'\nat = 60\ndo = [{ zone = 'noise', active = true }]";
    let mut pilot = pilot(far, 1);
    pilot.take_off(20.0);
    assert!(links(&mut pilot).iter().all(|link| link.loss == 0.0));
    pilot.goto(4000.0, 0.0, 200.0);
    let away = links(&mut pilot);
    assert!(
        away.is_sorted_by(|a, b| a.loss <= b.loss && a.delay <= b.delay),
        "{away:?}"
    );
    let last = away.last().expect("it is far away");
    assert!(last.is_cut(), "{last:?}");
    assert!(
        away.iter().any(|link| link.loss > 0.1 && !link.is_cut()),
        "{away:?}"
    );
    pilot.goto(60.0, 0.0, 200.0);
    assert!(
        links(&mut pilot)
            .last()
            .is_some_and(|link| link.loss == 0.0)
    );
    pilot.wait(60.0);
    assert!(
        links(&mut pilot).last().is_some_and(|link| link.is_cut()),
        "the noise is on"
    );
}

#[test]
fn an_alert_about_a_vehicle_is_one_that_scripts_can_wait_for() {
    let events = "
        [[events]]\nid = 'hot'\nat = 1\ndo = [{ alert = 'critical', vehicle = 1, text = 'hot', ok = 't > 20' }]
        [[events]]\nid = 'gust'\nat = 1\ndo = [{ alert = 'warning', text = 'gust', ok = 't > 20' }]";
    let mut pilot = pilot(events, 1);
    pilot.wait(3.0);
    assert_eq!(pilot.flight.findings().alerts, [Some(1), None]);
    pilot.wait(20.0);
    assert!(pilot.flight.findings().alerts.is_empty());
}
