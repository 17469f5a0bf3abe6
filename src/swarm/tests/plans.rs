//! Plans for several vehicles.

use super::*;
use crate::commands::{Datum, Ground, PlanTask};
use crate::plan::command;
use crate::plan::generate::Course;
use crate::vehicle::Place;
use crate::vehicle::{GlobalPosition, Vehicle};

/// A vehicle that stands at home.
fn standing() -> Vehicles {
    let mut vehicle = Vehicle::new(1, 1);
    vehicle.home = Some(Place {
        at_point: HOME,
        altitude_amsl_m: 180.0,
    });
    vehicle.global = Some(GlobalPosition {
        at_point: HOME,
        altitude_amsl_m: 180.0,
        altitude_m: 0.0,
        north_m_s: 0.0,
        east_m_s: 0.0,
        down_m_s: 0.0,
        heading_deg: None,
        at: Duration::ZERO,
    });
    Vehicles::from([(1, Arc::new(vehicle))])
}

/// The distance between two lines of a survey planned over a field of 40 m by 40 m.
fn planned_spacing_m(swath: Option<Swath>) -> f64 {
    let corners = [(20.0, 0.0), (60.0, 0.0), (60.0, 40.0), (20.0, 40.0)];
    let corners = corners.map(|(north_m, east_m)| HOME.moved(north_m, east_m));
    let task = PlanTask::Survey {
        ground: Ground::Outline(Outline::Polygon(corners.to_vec())),
        spacing_m: None,
        up_m: Some(0.7),
        course: Course::Degrees(0.0),
    };
    let conductor = Conductor::new(Rules {
        swath,
        ..Rules::default()
    });
    let plans = conductor.plans(&task, &[1], &standing(), &[]);
    let plans = plans.expect("there are plans");
    let items = plans.plans[0].1.plan.iter();
    let flown = items.filter(|item| item.command == command::WAYPOINT && item.z < 1.0);
    let mut easts_m: Vec<f64> = flown
        .map(|item| HOME.offset_to(LatLon::from_e7(item.x, item.y)).1)
        .collect();
    easts_m.sort_by(f64::total_cmp);
    let gaps_m = easts_m.windows(2).map(|pair| pair[1] - pair[0]);
    gaps_m.fold(0.0, f64::max)
}

/// The answer to `plan survey` says before the flight what it will cover.
#[test]
fn a_survey_says_how_much_of_its_area_it_covers() {
    let said = |swath, spacing_m| {
        let task = PlanTask::Survey {
            ground: Ground::Around {
                centre: Datum::Global(HOME.moved(60.0, 0.0)),
                radius_m: 50.0,
            },
            spacing_m: Some(spacing_m),
            up_m: Some(30.0),
            course: Course::Degrees(0.0),
        };
        let rules = Rules {
            swath,
            ..Rules::default()
        };
        let plans = Conductor::new(rules).plans(&task, &[1], &standing(), &[]);
        let words = plans.expect("there are plans").cover_words();
        words.map(|words| words.to_string())
    };
    let camera = Some(Swath {
        at_ground_m: 0.0,
        per_metre: 1.1,
    });
    let wide = said(camera, 41.25).expect("it is known");
    assert!(
        wide.starts_with("covers 80 % of the area") && wide.contains("33.0 m"),
        "{wide}"
    );
    assert!(
        said(camera, 27.0)
            .expect("it is known")
            .starts_with("covers 100 %")
    );
    assert_eq!(said(None, 27.0), None);
}

#[test]
fn planned_lines_lie_as_close_as_the_sensor_needs() {
    let strip = |at_ground_m| {
        planned_spacing_m(Some(Swath {
            at_ground_m,
            per_metre: 0.0,
        }))
    };
    assert!((strip(0.8) - 0.8).abs() < 0.05, "{}", strip(0.8));
    // Too narrow to set the spacing.
    assert!((strip(0.2) - planned_spacing_m(None)).abs() < 1e-9);
    assert!((planned_spacing_m(None) - 20.0).abs() < 0.05);
}
