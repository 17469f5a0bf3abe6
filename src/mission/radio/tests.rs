//! Tests of the radio model against closed-form results.

use super::*;

fn model(id: &str) -> Model {
    Model::by_id(id).expect("a known one")
}

fn ground() -> RadioNode {
    let radio = Radio {
        own: None,
        station: [0.0, 0.0],
        antenna_m: 2.0,
    };
    radio.ground(model("r_wifi24"))
}

fn node(at: Point, height_m: f64) -> RadioNode {
    RadioNode {
        model: model("r_wifi24"),
        at,
        height_m,
        gain_dbi: 2.0,
        relays: true,
    }
}

#[test]
fn losses_are_those_of_the_recommendations() {
    // ITU-R P.525: 92.45 dB at 1 km and 1 GHz; 6.02 dB for each doubling.
    for (distance_m, mhz, expected_db) in [
        (1000.0, 1000.0, 92.44),
        (2000.0, 1000.0, 98.46),
        (300.0, 2437.0, 89.72),
    ] {
        let loss_db = free_space_db(distance_m, mhz);
        assert!(
            (loss_db - expected_db).abs() < 0.02,
            "{distance_m}: {loss_db}"
        );
    }
    // The two-ray model: 12.04 dB for each doubling, 6.02 less for twice the height.
    let near_db = two_ray_db(1000.0, 2.0, 50.0);
    assert!((near_db - 80.0).abs() < 1e-9, "{near_db}");
    assert!((two_ray_db(2000.0, 2.0, 50.0) - near_db - 12.04).abs() < 0.01);
    assert!((two_ray_db(1000.0, 4.0, 50.0) - near_db + 6.02).abs() < 0.01);
    // ITU-R P.526, figure 9: 6 dB at grazing, 14 dB at 1, 20.5 dB at 2.4.
    for (v, expected_db) in [(-1.0, 0.0), (0.0, 6.0), (1.0, 13.9), (2.4, 20.5)] {
        assert!((knife_edge_db(v) - expected_db).abs() < 0.1, "{v}");
    }
}

#[test]
fn budgets_are_those_of_the_parts_catalogue() {
    for (id, most_db) in [
        ("r_wifi24", 89.0),
        ("r_sik433", 104.0),
        ("r_rfd900", 119.0),
        ("r_elrs24", 107.0),
        ("r_lora868", 122.0),
        ("r_mesh24", 108.0),
    ] {
        let radio = model(id).radio;
        let budget_db = radio.power_dbm + radio.air_dbi + radio.ground_dbi
            - radio.losses_db
            - radio.sensitivity_dbm;
        let with_fade_db = budget_db - 20.0;
        assert!(
            (with_fade_db - most_db).abs() <= 1.0,
            "{id}: {with_fade_db}"
        );
    }
}

#[test]
fn half_of_the_frames_are_lost_at_a_margin_of_three() {
    assert!((loss(3.0) - 0.5).abs() < 1e-9);
    assert!(loss(10.0) < 0.01 && loss(-4.0) > 0.99);
    assert_eq!(Radio::fault(20.0), RadioFault::default());
    assert!(Radio::fault(-6.0).is_cut());
    let delays = [12.0, 6.0, 3.0, 0.0].map(|margin| Radio::fault(margin).delay);
    assert!(delays.is_sorted(), "{delays:?}");
}

#[test]
fn a_ridge_is_in_the_way_unless_somebody_above_it_passes_things_on() {
    let ridge = Shape::Polygon(vec![
        [-500.0, 150.0],
        [500.0, 150.0],
        [500.0, 170.0],
        [-500.0, 170.0],
    ]);
    let zones = [(
        &ridge,
        ZoneKind::CommShadow(Shadow::Ridge { height_m: 60.0 }),
    )];
    let behind = node([0.0, 300.0], 15.0);
    let above = node([0.0, 160.0], 90.0);
    let ground = ground();
    let open_db = margin_db(&ground, &behind, &[]);
    let hidden_db = margin_db(&ground, &behind, &zones);
    // One edge 53 m above the path, 155 m from one end and 145 m from the other, at 12.3 cm.
    let v = 52.5 * f64::sqrt(2.0 * 300.0 / (0.123 * 150.0 * 150.0));
    assert!(
        (open_db - hidden_db - knife_edge_db(v)).abs() < 1.0,
        "{open_db} {hidden_db}"
    );
    let alone = best_db(&[behind, ground], &zones);
    let relayed = best_db(&[behind, above, ground], &zones);
    assert!((alone[0] - hidden_db).abs() < 1e-9);
    let legs = margin_db(&ground, &above, &zones).min(margin_db(&above, &behind, &zones));
    assert!(
        (relayed[0] - legs).abs() < 1e-9 && relayed[0] > 15.0,
        "{relayed:?}"
    );
    // A vehicle that does not relay does not help.
    let deaf = RadioNode {
        relays: false,
        ..above
    };
    let useless = best_db(&[behind, deaf, ground], &zones);
    assert!((useless[0] - alone[0]).abs() < 1e-9);
}

#[test]
fn two_hops_reach_where_one_does_not() {
    let chain: Vec<RadioNode> = [3000.0, 2000.0, 1000.0]
        .map(|north| node([0.0, north], 60.0))
        .to_vec();
    let with = |nodes: &[RadioNode]| {
        let mut nodes = nodes.to_vec();
        nodes.push(ground());
        best_db(&nodes, &[])[0]
    };
    let (alone, one, two) = (with(&chain[..1]), with(&[chain[0], chain[2]]), with(&chain));
    assert!(alone < one && one < two, "{alone} {one} {two}");
}

#[test]
fn noise_and_walls_weaken_the_links_inside_them() {
    let circle = Shape::Circle {
        center: [0.0, 200.0],
        radius_m: 50.0,
    };
    let ground = ground();
    let margin = |north: f64, kind| {
        margin_db(&ground, &node([0.0, north], 30.0), &[(&circle, kind)])
            - margin_db(&ground, &node([0.0, north], 30.0), &[])
    };
    let noise = ZoneKind::RadioJam {
        noise_db: 20.0,
        edge_m: 40.0,
    };
    let walls = ZoneKind::CommShadow(Shadow::Inside { loss_db: 25.0 });
    for (north, kind, expected_db) in [
        (200.0, noise, -20.0),
        (270.0, noise, -10.0),
        (300.0, noise, 0.0),
        (200.0, walls, -25.0),
        (270.0, walls, 0.0),
    ] {
        let change_db = margin(north, kind);
        assert!(
            (change_db - expected_db).abs() < 1e-9,
            "{north}: {change_db}"
        );
    }
}
