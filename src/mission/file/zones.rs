//! `[[zones]]`: areas with a shape and a kind.

use crate::mission::format::{FileTable, KindOf, NameKind, POINT_RANGE, flag, list, number, point};
use crate::mission::zone::{Shadow, Shape, Zone, ZoneKind};
use crate::text;

/// The ceiling of zones that do not set one.
const HIGHEST_M: f64 = 10_000.0;
const MOST_CORNERS: usize = 1000;

pub(super) fn zone(table: &mut FileTable<'_>) -> Option<Zone> {
    let id = table.need_id("zones");
    let shape = shape(table);
    let active = table.or(
        "active",
        flag(),
        true,
        "`false`: off until an event switches it on",
    );
    let jitter_m = table.may(
        "jitter",
        number(0.0, 1000.0, "m"),
        "the seed moves the zone by up to this distance on each axis; not for `task` and `geofence`",
    );
    let (_, kind) = table.need_kind(NameKind::ZoneKind, ZONE_KINDS)?;
    if jitter_m.is_some() && is_fixed(kind) {
        table.fault_of("jitter", text!("fault-zone-fixed"));
    }
    id?;
    Some(Zone {
        id: table.own_id(),
        kind,
        shape: shape?,
        active,
        jitter_m: jitter_m.unwrap_or(0.0),
    })
}

/// Whether the seed never moves zones of a kind, because objectives and hazards depend on their position.
fn is_fixed(kind: ZoneKind) -> bool {
    matches!(kind, ZoneKind::Task | ZoneKind::Geofence { .. })
}

/// The shape of a zone: `polygon`, or `center` and `radius`.
fn shape(table: &mut FileTable<'_>) -> Option<Shape> {
    let corners_form = list(point(), 3, MOST_CORNERS);
    let corners = table.may(
        "polygon",
        corners_form,
        "corners of the zone, unless it is a circle",
    );
    let center = table.may("center", point(), "centre, if the zone is a circle");
    let radius_m = table.may(
        "radius",
        number(0.1, POINT_RANGE, "m"),
        "radius, if the zone is a circle",
    );
    let is_circle = table.is_written("center") || table.is_written("radius");
    if is_circle == table.is_written("polygon") {
        table.fault(text!("fault-zone-shape"));
        return None;
    }
    match (corners, center, radius_m) {
        (Some(corners), ..) => Some(Shape::Polygon(corners)),
        (None, Some(center), Some(radius_m)) => Some(Shape::Circle { center, radius_m }),
        _ => {
            let keys = ["center", "radius"].into_iter().filter(|_| is_circle);
            for key in keys {
                if !table.is_written(key) {
                    table.fault(text!("fault-key-missing", name = key));
                }
            }
            None
        }
    }
}

const ZONE_KINDS: &[KindOf<ZoneKind>] = &[
    KindOf {
        name: "task",
        about: "an area that hazards and objectives refer to",
        read: |_| Some(ZoneKind::Task),
    },
    KindOf {
        name: "geofence",
        about: "a fence: vehicles must stay inside it and below its ceiling",
        read: geofence,
    },
    KindOf {
        name: "no_fly",
        about: "an area in which flying is forbidden between two heights",
        read: no_fly,
    },
    KindOf {
        name: "gnss_jam",
        about: "an area in which satellite navigation fails; a vehicle regains it 5 m outside",
        read: gnss_jam,
    },
    KindOf {
        name: "gnss_glitch",
        about: "an area in which satellite navigation shows a wrong position",
        read: gnss_glitch,
    },
    KindOf {
        name: "people",
        about: "an area with people, over which vehicles must not fly low",
        read: people,
    },
    KindOf {
        name: "radio_jam",
        about: "a source of radio noise; needs `[radio]`",
        read: radio_jam,
    },
    KindOf {
        name: "comm_shadow",
        about: "an obstacle to radio: a ridge, or walls and trees; needs `[radio]`",
        read: comm_shadow,
    },
];

fn geofence(table: &mut FileTable<'_>) -> Option<ZoneKind> {
    let ceiling = number(1.0, HIGHEST_M, "m");
    Some(ZoneKind::Geofence {
        ceiling_m: table.may("ceiling", ceiling, "maximum height"),
    })
}

fn no_fly(table: &mut FileTable<'_>) -> Option<ZoneKind> {
    let height = number(0.0, HIGHEST_M, "m");
    let floor_m = table.or("floor", height, 0.0, "flying below this height is allowed");
    let ceiling_m = table.or(
        "ceiling",
        height,
        HIGHEST_M,
        "flying above this height is allowed",
    );
    if floor_m >= ceiling_m {
        table.fault(text!("fault-zone-floor"));
    }
    Some(ZoneKind::NoFly { floor_m, ceiling_m })
}

fn gnss_jam(table: &mut FileTable<'_>) -> Option<ZoneKind> {
    let edge = number(0.0, 1000.0, "m");
    Some(ZoneKind::GnssJam {
        edge_m: table.or(
            "edge",
            edge,
            0.0,
            "width of the rim in which satellites are lost one by one",
        ),
    })
}

fn gnss_glitch(table: &mut FileTable<'_>) -> Option<ZoneKind> {
    let offset_m = table.need("offset", point(), "error of the indicated position");
    Some(ZoneKind::GnssGlitch {
        offset_m: offset_m?,
    })
}

fn people(table: &mut FileTable<'_>) -> Option<ZoneKind> {
    let below_m = table.need(
        "below",
        number(1.0, 1000.0, "m"),
        "minimum height above the area",
    );
    Some(ZoneKind::People { below_m: below_m? })
}

fn radio_jam(table: &mut FileTable<'_>) -> Option<ZoneKind> {
    let noise_db = table.need("noise", number(0.0, 100.0, "dB"), "added noise");
    let edge_m = table.or(
        "edge",
        number(0.0, 1000.0, "m"),
        0.0,
        "width of the rim in which the noise fades",
    );
    Some(ZoneKind::RadioJam {
        noise_db: noise_db?,
        edge_m,
    })
}

fn comm_shadow(table: &mut FileTable<'_>) -> Option<ZoneKind> {
    let height_m = table.may("height", number(1.0, 5000.0, "m"), "height of a ridge");
    let loss = number(0.0, 200.0, "dB");
    let loss_db = table.may(
        "loss",
        loss,
        "loss through walls and trees, for all vehicles inside",
    );
    match (height_m, loss_db) {
        (Some(height_m), None) => Some(ZoneKind::CommShadow(Shadow::Ridge { height_m })),
        (None, Some(loss_db)) => Some(ZoneKind::CommShadow(Shadow::Inside { loss_db })),
        _ => {
            let message = "a `comm_shadow` has either the `height` of a ridge in m, or a `loss` for the vehicles inside in dB";
            table.fault(message);
            None
        }
    }
}
