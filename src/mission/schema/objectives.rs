//! The keys of each kind of objective.

use super::keys::{COUNT, Is, Key, SHARE};
use super::kinds::{JITTER, NAME, ZONE};
use super::{Kind, may, need};

const RADIUS: Is = Is::Number(0.5, 1000.0);
const TARGET: Key = need("target", SHARE, "what is asked for, a share");
const PARTIAL: Key = need("partial_from", SHARE, "where points begin");
const GATES: Key = need(
    "gates",
    Is::List(&Is::Gate),
    "[east, north, up], in their order",
);

const HEIGHTS: Key = need("heights", Is::Span, "[low, high], m");
const WITHIN_M: Key = need("radius", RADIUS, "how near counts, m");
const OF_FIRE: Key = need("of", NAME, "id of a fire");
const HAZARD: Key = need("hazard", NAME, "id of a hazard");

pub(super) const OBJECTIVES: &[Kind] = &[
    (
        "arm_time",
        &[need(
            "within",
            Is::Number(1.0, 3600.0),
            "s after it was ready",
        )],
    ),
    (
        "hover",
        &[
            HEIGHTS,
            WITHIN_M,
            need("time", Is::Number(0.5, 3600.0), "without a break, s"),
            may("place", NAME, "where (anywhere)"),
        ],
    ),
    ("gates", &[GATES, WITHIN_M, JITTER]),
    (
        "visit",
        &[
            need("places", Is::List(&NAME), "1 to 100, in any order"),
            WITHIN_M,
            may("dwell", Is::Number(0.0, 600.0), "s (0)"),
            may("heights", Is::Span, "[low, high], m (any)"),
        ],
    ),
    (
        "formation",
        &[
            GATES,
            WITHIN_M,
            JITTER,
            need(
                "spacing",
                Is::Span,
                "to the nearest other, [least, most], m",
            ),
            TARGET,
            PARTIAL,
        ],
    ),
    (
        "land_on",
        &[
            need("place", NAME, "where"),
            WITHIN_M,
            may("count", Is::Whole(1, 250), "how many (1)"),
        ],
    ),
    (
        "recover",
        &[
            need("radius", RADIUS, "around the pads, m"),
            need("battery_pct", Is::Number(0.0, 100.0), "left, percent"),
        ],
    ),
    (
        "sample_cells",
        &[
            ZONE,
            need("sensor", Is::Sensor, "one that measures"),
            need("cell", Is::Number(1.0, 1000.0), "side of a cell, m"),
            need("dwell", Is::Number(0.1, 600.0), "in each, s"),
            need("max_speed", Is::Number(0.1, 100.0), "m/s"),
            HEIGHTS,
            need("target", Is::Whole(1, 10_000), "cells"),
            may("partial_from", Is::Whole(0, 10_000), "cells (0)"),
        ],
    ),
    (
        "map_error",
        &[
            need("of", NAME, "id of an earlier sample_cells"),
            need("height", Is::Number(0.0, 1000.0), "of the map, m"),
            need("target", Is::Number(0.0, 10.0), "error"),
            need("partial_from", Is::Number(0.0, 10.0), "a larger error"),
        ],
    ),
    (
        "locate",
        &[
            need("of", NAME, "id of a hazard"),
            need("within", Is::Number(0.1, 10_000.0), "m"),
            need("partial_to", Is::Number(0.1, 10_000.0), "farther, m"),
        ],
    ),
    ("dose", &[need("limit_usv", Is::Number(1e-3, 1e6), "uSv")]),
    (
        "perimeter",
        &[
            OF_FIRE,
            need("sensor", Is::Sensor, "a camera"),
            need("times", Is::List(&Is::Number(1.0, 86_400.0)), "rising, s"),
            TARGET,
            may("partial_from", SHARE, "where points begin (0)"),
        ],
    ),
    ("protect", &[OF_FIRE, ZONE]),
    ("contain", &[OF_FIRE, TARGET, PARTIAL]),
    (
        "coverage",
        &[
            ZONE,
            need("sensors", Is::List(&Is::Sensor), "that find things"),
            need("cell", Is::Number(0.2, 1000.0), "m"),
            TARGET,
            PARTIAL,
        ],
    ),
    (
        "detect",
        &[
            HAZARD,
            need(
                "beta",
                Is::Number(0.1, 10.0),
                "how much worse a miss is than a false alarm",
            ),
            need(
                "radius",
                Is::Number(0.1, 1000.0),
                "how near a report counts, m",
            ),
            may(
                "budget",
                Is::Number(1.0, 100.0),
                "reports that count for each object (3)",
            ),
            TARGET,
            PARTIAL,
        ],
    ),
    (
        "deliver",
        &[
            HAZARD,
            need("load", Is::Word(&["kit", "node"]), "what"),
            need("target", COUNT, "pieces"),
            may("partial_from", COUNT, "pieces (0)"),
        ],
    ),
    (
        "standoff",
        &[
            need("hazard", NAME, "id of a line"),
            need("range", Is::Span, "[nearest, farthest], m"),
            need("near", Is::Number(1.0, 1000.0), "where time counts, m"),
            need("time", Is::Number(1.0, 86_400.0), "to spend there, s"),
            TARGET,
            PARTIAL,
        ],
    ),
    (
        "link",
        &[
            ZONE,
            need("margin", Is::Number(-20.0, 60.0), "dB"),
            need(
                "time",
                Is::Number(1.0, 86_400.0),
                "vehicle seconds in the zone",
            ),
            TARGET,
            PARTIAL,
        ],
    ),
];
