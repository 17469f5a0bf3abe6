//! Verbs that several vehicles carry out together.

use strum::VariantNames as _;

use super::{Built, CHANGE, manoeuvre};
use crate::commands::{Datum, FarEnd, Ground, Manoeuvre, Pattern, Shape};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::vehicle::VehicleId;
use crate::vehicle_id::HIGHEST_VEHICLE;
use crate::verb::{Arrival, CountsAs, CrewDuty, Danger, Movement, Precedence, Unsuited, Verb};

pub(super) static ROWS: &[VerbRow] = &[SURVEY, SEARCH, FORMATION, FOLLOW, SPREAD];

pub(super) const HEIGHT: Kind = Kind::Number(Unit::Metres, 0.5, 10_000.0);
pub(super) const WAY: Kind = Kind::Number(Unit::Metres, -100_000.0, 100_000.0);
pub(super) const HEADING: Kind = Kind::Number(Unit::Degrees, 0.0, 360.0);
/// The gap between lines; for a mine detector, it is below a metre.
const LINE_GAP: Kind = Kind::Number(Unit::Metres, 0.3, 1000.0);
/// The gap between vehicles.
pub(super) const GAP: Kind = Kind::Number(Unit::Metres, 1.0, 1000.0);
pub(super) const RADIUS: Kind = Kind::Number(Unit::Metres, 1.0, 10_000.0);
const VEHICLE: Kind = Kind::Whole(Unit::None, 1.0, HIGHEST_VEHICLE as f64);

pub(super) const NORTH: Argument = Argument::keyed("n", "north", WAY, "argument-north-of-origin");
pub(super) const EAST: Argument = Argument::keyed("e", "east", WAY, "argument-east-of-origin");
const UP: Argument = Argument::keyed("up", "up", HEIGHT, "argument-swarm-height").optional();
pub(super) const LINES: Argument =
    Argument::keyed("spacing", "spacing", LINE_GAP, "argument-line-spacing").optional();
pub(super) const COURSE: Argument =
    Argument::keyed("course", "course", HEADING, "argument-line-course").optional();
pub(super) const AROUND: Argument = Argument::flag("around", "argument-around");
pub(super) const POINT: Argument = Argument::value("point", Kind::Point, "argument-place");

/// Joint manoeuvres separate vehicles by height, and steer them with setpoints, which planes ignore.
const JOINT_FLIGHT: &[Unsuited] = &[
    Unsuited::surface("unsuited-joint"),
    Unsuited::plane("unsuited-joint"),
];

const SURVEY: VerbRow = VerbRow {
    verb: Verb {
        name: "survey",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::To(Arrival::Done),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: JOINT_FLIGHT,
    },
    scope: Scope::Everywhere,
    aliases: &["scan"],
    examples: &[
        "@red survey lane spacing 12 up 25",
        "all survey n 0 e 0 to n 120 e 60 up 30",
        "all survey around 50.4501 30.5234 radius 40 course 90",
    ],
    forms: &[
        Form::new(
            &[
                NORTH,
                EAST,
                Argument::flag("to", "argument-opposite-corner"),
                Argument::keyed("n", "far north", WAY, "argument-north-of-origin"),
                Argument::keyed("e", "far east", WAY, "argument-east-of-origin"),
                LINES,
                UP,
                COURSE,
            ],
            |given| {
                let ground = Ground::Between(
                    local(given, "north", "east")?,
                    local(given, "far north", "far east")?,
                );
                survey(given, ground)
            },
        ),
        Form::new(
            &[
                AROUND,
                POINT,
                Argument::keyed("radius", "radius", RADIUS, "argument-circle-radius"),
                LINES,
                UP,
                COURSE,
            ],
            |given| {
                let ground = Ground::Around {
                    centre: Datum::Global(given.required_point("point")?),
                    radius_m: given.required("radius")?,
                };
                survey(given, ground)
            },
        ),
        Form::new(
            &[
                Argument::value("area", Kind::Area, "argument-area"),
                LINES,
                UP,
                COURSE,
            ],
            |given| survey(given, Ground::Outline(given.required_area("area")?.clone())),
        ),
    ],
};

fn survey(given: &Arguments, ground: Ground) -> Built {
    manoeuvre(Manoeuvre::Survey {
        ground,
        spacing_m: given.number("spacing"),
        up_m: given.number("up"),
        course_deg: given.number("course"),
    })
}

const FORMATION: VerbRow = VerbRow {
    verb: Verb {
        name: "formation",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::Station,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: JOINT_FLIGHT,
    },
    scope: Scope::Everywhere,
    aliases: &["form"],
    examples: &[
        "all formation wedge spacing 10",
        "all formation line face 90",
        "all formation off",
    ],
    forms: &[
        Form::new(
            &[
                Argument::value("shape", Kind::Choice(Shape::VARIANTS), "argument-shape"),
                Argument::keyed("spacing", "spacing", GAP, "argument-neighbour-spacing").optional(),
                UP,
                Argument::keyed("face", "heading", HEADING, "argument-formation-face").optional(),
            ],
            |given| {
                manoeuvre(Manoeuvre::Formation {
                    shape: given.required_choice("shape")?,
                    spacing_m: given.number("spacing"),
                    up_m: given.number("up"),
                    face_deg: given.number("heading"),
                })
            },
        ),
        Form::new(&[Argument::flag("off", "argument-formation-off")], |_| {
            manoeuvre(Manoeuvre::Disband)
        })
        .meaning(&DISBAND),
    ],
};

const FOLLOW: VerbRow = VerbRow {
    verb: Verb {
        name: "follow",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::Station,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: JOINT_FLIGHT,
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["2-4 follow 1 distance 15", "2 follow 1 up 40"],
    forms: &[Form::new(
        &[
            Argument::value("leader", VEHICLE, "argument-leader"),
            Argument::keyed("distance", "distance", GAP, "argument-follow-distance").optional(),
            Argument::keyed("up", "up", HEIGHT, "argument-follow-height").optional(),
        ],
        |given| {
            manoeuvre(Manoeuvre::Follow {
                leader: given.required("leader")? as VehicleId,
                distance_m: given.number("distance").unwrap_or(FOLLOW_DISTANCE_M),
                up_m: given.number("up"),
            })
        },
    )],
};

/// The distance that keeps a follower clear of a leader that stops suddenly.
const FOLLOW_DISTANCE_M: f64 = 15.0;

const SPREAD: VerbRow = VerbRow {
    verb: Verb {
        name: "spread",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::To(Arrival::Done),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: JOINT_FLIGHT,
    },
    scope: Scope::Everywhere,
    aliases: &["disperse"],
    examples: &["all spread 20"],
    forms: &[Form::new(
        &[Argument::value("distance", GAP, "argument-spread")],
        |given| {
            manoeuvre(Manoeuvre::Spread {
                spacing_m: given.required("distance")?,
            })
        },
    )],
};

pub(super) const PATTERN: Argument = Argument::value(
    "pattern",
    Kind::Choice(Pattern::VARIANTS),
    "argument-pattern",
);
pub(super) const REACH: Argument =
    Argument::keyed("radius", "radius", RADIUS, "argument-search-radius").optional();

const SEARCH: VerbRow = VerbRow {
    verb: Verb {
        name: "search",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::Station,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: JOINT_FLIGHT,
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "1 search square around 50.4501 30.5234 spacing 20",
        "1-3 search sector n 200 e 50 radius 100 up 40",
    ],
    forms: &[
        Form::new(&[PATTERN, AROUND, POINT, REACH, LINES, UP], |given| {
            search(given, Datum::Global(given.required_point("point")?))
        }),
        Form::new(&[PATTERN, NORTH, EAST, REACH, LINES, UP], |given| {
            search(given, local(given, "north", "east")?)
        }),
    ],
};

fn search(given: &Arguments, datum: Datum) -> Built {
    manoeuvre(Manoeuvre::Search {
        pattern: given.required_choice("pattern")?,
        datum,
        radius_m: given.number("radius"),
        spacing_m: given.number("spacing"),
        up_m: given.number("up"),
    })
}

const TO: Argument = Argument::flag("to", "argument-relay-to");

const CHAIN: Verb = Verb {
    name: "relay to",
    danger: Danger::None,
    retry: CHANGE,
    precedence: Precedence::InTurn,
    movement: Movement::Station,
    counts_as: CountsAs::Task,
    duty: CrewDuty::Flying,
    unsuited: JOINT_FLIGHT,
};
const DISBAND: Verb = Verb {
    name: "formation off",
    danger: Danger::None,
    retry: CHANGE,
    precedence: Precedence::InTurn,
    movement: Movement::To(Arrival::Done),
    counts_as: CountsAs::Task,
    duty: CrewDuty::Flying,
    unsuited: &[],
};

/// The forms of `relay` that build a chain of vehicles; those that switch a relay are in the table
/// of devices.
pub(super) const CHAIN_TO_PLACE: Form = Form::new(&[TO, NORTH, EAST, UP], |given| {
    chain(given, FarEnd::Place(local(given, "north", "east")?))
})
.meaning(&CHAIN);
pub(super) const CHAIN_TO_POINT: Form = Form::new(&[TO, POINT, UP], |given| {
    chain(
        given,
        FarEnd::Place(Datum::Global(given.required_point("point")?)),
    )
})
.meaning(&CHAIN);
pub(super) const CHAIN_TO_VEHICLE: Form = Form::new(
    &[
        TO,
        Argument::keyed("vehicle", "vehicle", VEHICLE, "argument-relay-vehicle"),
        UP,
    ],
    |given| {
        chain(
            given,
            FarEnd::Vehicle(given.required("vehicle")? as VehicleId),
        )
    },
)
.meaning(&CHAIN);

fn chain(given: &Arguments, to: FarEnd) -> Built {
    manoeuvre(Manoeuvre::Chain {
        to,
        up_m: given.number("up"),
    })
}

pub(super) fn local(
    given: &Arguments,
    north: &'static str,
    east: &'static str,
) -> Result<Datum, Problem> {
    Ok(Datum::Local {
        north_m: given.required(north)?,
        east_m: given.required(east)?,
    })
}
