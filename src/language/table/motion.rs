//! Verbs that move a vehicle in GUIDED, its point of interest and its home.

use std::time::Duration;

use strum::VariantNames as _;

use super::{Built, CHANGE, SETPOINT, command, given, setting};
use crate::commands::{Command, Destination, Heading, MotionCommand};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::text;
use crate::vehicle::SpeedAxis;
use crate::verb::{Arrival, CountsAs, CrewDuty, Danger, Movement, Precedence, Unsuited, Verb};

pub(super) static ROWS: &[VerbRow] = &[GOTO, ALTITUDE, SPEED, YAW, VELOCITY, ORBIT, ROI, HOME];

/// Heights above home or the origin; the minimum keeps vehicles off the ground.
const HEIGHT: Kind = Kind::Number(Unit::Metres, 0.5, 10_000.0);
/// Distances in the local frame.
const WAY: Kind = Kind::Number(Unit::Metres, -100_000.0, 100_000.0);
const HEADING: Kind = Kind::Number(Unit::Degrees, 0.0, 360.0);
const VELOCITY_LIMIT: Kind = Kind::Number(Unit::MetresPerSecond, -50.0, 50.0);

const KEEP: Argument = Argument::flag("keep", "argument-keep").optional();
const FACE: Argument = Argument::keyed("face", "heading", HEADING, "argument-face").optional();

const GOTO: VerbRow = VerbRow {
    verb: Verb {
        name: "goto",
        danger: Danger::None,
        retry: SETPOINT,
        precedence: Precedence::InTurn,
        movement: Movement::To(Arrival::Done),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &["go"],
    examples: &[
        "1-2 goto n 100 e 50 up 30",
        "goto by n 10 e -5 up 2",
        "3 goto 50.4501 30.5234 up 40 keep",
        "goto n 0 e 0 face 90deg",
    ],
    forms: &[
        Form::new(
            &[
                Argument::keyed("n", "north", WAY, "argument-north-of-origin"),
                Argument::keyed("e", "east", WAY, "argument-east-of-origin"),
                Argument::keyed("up", "up", HEIGHT, "argument-above-origin").optional(),
                KEEP,
                FACE,
            ],
            |given| {
                goto(
                    given,
                    Destination::Local {
                        north_m: given.required("north")?,
                        east_m: given.required("east")?,
                        up_m: given.number("up"),
                    },
                )
            },
        ),
        Form::new(
            &[
                Argument::flag("by", "argument-from-here"),
                Argument::keyed("n", "north", WAY, "argument-to-north").optional(),
                Argument::keyed("e", "east", WAY, "argument-to-east").optional(),
                Argument::keyed("up", "up", WAY, "argument-upwards").optional(),
                KEEP,
                FACE,
            ],
            goto_by,
        ),
        Form::new(
            &[
                Argument::value("point", Kind::Point, "argument-place"),
                Argument::keyed("up", "up", HEIGHT, "argument-above-home").optional(),
                KEEP,
                FACE,
            ],
            |given| {
                goto(
                    given,
                    Destination::Global {
                        at_point: given.required_point("point")?,
                        altitude_m: given.number("up"),
                    },
                )
            },
        ),
    ],
};

fn goto_by(arguments: &Arguments) -> Built {
    if given(arguments, &["north", "east", "up"]).is_none() {
        return Err(Problem::new("by", text!("grammar-by-how-much")));
    }
    let part = |name| arguments.number(name).unwrap_or(0.0);
    goto(
        arguments,
        Destination::Offset {
            north_m: part("north"),
            east_m: part("east"),
            up_m: part("up"),
        },
    )
}

fn goto(arguments: &Arguments, destination: Destination) -> Built {
    let heading = match (arguments.flag("keep"), arguments.number("heading")) {
        (true, Some(_)) => {
            let message = text!("grammar-keep-or-face");
            return Err(Problem::new("heading", message));
        }
        (true, None) => Heading::Keep,
        (false, Some(degrees)) => Heading::Fixed(degrees),
        (false, None) => Heading::Auto,
    };
    command(Command::Motion(MotionCommand::Goto {
        destination,
        heading,
    }))
}

const ALTITUDE: VerbRow = VerbRow {
    verb: Verb {
        name: "altitude",
        danger: Danger::None,
        retry: SETPOINT,
        precedence: Precedence::InTurn,
        movement: Movement::To(Arrival::Done),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[Unsuited::surface("unsuited-altitude-surface")],
    },
    scope: Scope::Everywhere,
    aliases: &["alt"],
    examples: &["altitude 35", "2 alt 12.5m"],
    forms: &[Form::new(
        &[Argument::value("altitude", HEIGHT, "argument-height")],
        |given| {
            command(Command::Motion(MotionCommand::Altitude {
                altitude_m: given.required("altitude")?,
            }))
        },
    )],
};

const SPEED: VerbRow = VerbRow {
    verb: Verb {
        name: "speed",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Setting,
        duty: CrewDuty::Flying,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["speed 5", "all speed climb 2m/s"],
    forms: &[Form::new(
        &[
            Argument::value("axis", Kind::Choice(SpeedAxis::VARIANTS), "argument-axis").optional(),
            Argument::value("speed", Kind::Number(Unit::MetresPerSecond, 0.1, 100.0), ""),
        ],
        |given| {
            command(Command::Motion(MotionCommand::Speed {
                axis: given.choice("axis")?.unwrap_or_default(),
                speed_m_s: given.required("speed")?,
            }))
        },
    )],
};

const YAW: VerbRow = VerbRow {
    verb: Verb {
        name: "yaw",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::Turn,
        counts_as: CountsAs::Setting,
        duty: CrewDuty::Flying,
        unsuited: &[
            Unsuited::surface("unsuited-yaw"),
            Unsuited::plane("unsuited-yaw"),
        ],
    },
    scope: Scope::Everywhere,
    aliases: &["turn"],
    examples: &["yaw 270", "yaw by -90deg rate 30"],
    forms: &[
        Form::new(
            &[
                Argument::value("angle", HEADING, "argument-heading"),
                Argument::keyed("rate", "rate", TURN_RATE, "argument-turn-rate").optional(),
            ],
            |given| yaw(given, false),
        ),
        Form::new(
            &[
                Argument::flag("by", "argument-by-heading").optional(),
                Argument::value(
                    "angle",
                    Kind::Number(Unit::Degrees, -180.0, 180.0),
                    "argument-clockwise",
                ),
                Argument::keyed("rate", "rate", TURN_RATE, "argument-turn-rate").optional(),
            ],
            yaw_by,
        ),
    ],
};

fn yaw_by(arguments: &Arguments) -> Built {
    if arguments.flag("by") {
        return yaw(arguments, true);
    }
    Err(Problem::new("angle", text!("grammar-heading-range")))
}

const TURN_RATE: Kind = Kind::Number(Unit::DegreesPerSecond, 1.0, 360.0);

fn yaw(arguments: &Arguments, relative: bool) -> Built {
    command(Command::Motion(MotionCommand::Yaw {
        angle_deg: arguments.required("angle")?,
        relative,
        rate_deg_s: arguments.number("rate"),
    }))
}

const VELOCITY: VerbRow = VerbRow {
    verb: Verb {
        name: "velocity",
        danger: Danger::None,
        retry: SETPOINT,
        precedence: Precedence::InTurn,
        movement: Movement::To(Arrival::Done),
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[Unsuited::plane("unsuited-velocity-plane")],
    },
    scope: Scope::Everywhere,
    aliases: &["vel"],
    examples: &["velocity n 1 e 0 d 0 for 5s", "2 velocity up 0.5m/s for 10"],
    forms: &[Form::new(
        &[
            Argument::keyed("n", "north", VELOCITY_LIMIT, "argument-northwards").optional(),
            Argument::keyed("e", "east", VELOCITY_LIMIT, "argument-eastwards").optional(),
            Argument::keyed("d", "down", VELOCITY_LIMIT, "argument-downwards").optional(),
            Argument::keyed("up", "up", VELOCITY_LIMIT, "argument-upwards").optional(),
            Argument::keyed(
                "for",
                "time",
                Kind::Number(Unit::Seconds, 0.2, 600.0),
                "argument-duration",
            ),
        ],
        velocity,
    )],
};

fn velocity(arguments: &Arguments) -> Built {
    if given(arguments, &["north", "east", "down", "up"]).is_none() {
        return Err(Problem::new("time", text!("grammar-which-way")));
    }
    if arguments.flag("down") && arguments.flag("up") {
        return Err(Problem::new("up", text!("grammar-down-or-up")));
    }
    let part = |name| arguments.number(name).unwrap_or(0.0);
    command(Command::Motion(MotionCommand::Velocity {
        ned_m_s: [
            part("north"),
            part("east"),
            arguments.number("up").map_or(part("down"), |up| -up),
        ],
        lasting: Duration::from_secs_f64(arguments.required("time")?),
    }))
}

const ORBIT: VerbRow = VerbRow {
    verb: Verb {
        name: "orbit",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::Station,
        counts_as: CountsAs::Task,
        duty: CrewDuty::Flying,
        unsuited: &[
            Unsuited::surface("unsuited-orbit-surface"),
            Unsuited::plane("unsuited-orbit-plane"),
        ],
    },
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["orbit 30", "orbit -20m speed 3 at 50.4501 30.5234 up 25"],
    forms: &[Form::new(
        &[
            Argument::value(
                "radius",
                Kind::Number(Unit::Metres, -10_000.0, 10_000.0),
                "argument-clockwise",
            ),
            Argument::keyed(
                "speed",
                "speed",
                Kind::Number(Unit::MetresPerSecond, 0.1, 50.0),
                "argument-orbit-speed",
            )
            .optional(),
            Argument::keyed("at", "centre", Kind::Point, "argument-orbit-centre").optional(),
            Argument::keyed("up", "up", HEIGHT, "argument-above-home").optional(),
        ],
        |given| {
            let radius_m = given.required("radius")?;
            if radius_m.abs() < 1.0 {
                return Err(Problem::new("radius", text!("grammar-small-circle")));
            }
            command(Command::Motion(MotionCommand::Orbit {
                radius_m,
                speed_m_s: given.number("speed").unwrap_or(3.0),
                centre: given.point("centre"),
                altitude_m: given.number("up"),
            }))
        },
    )],
};

const ROI: VerbRow = VerbRow {
    verb: Verb {
        name: "roi",
        danger: Danger::None,
        retry: CHANGE,
        precedence: Precedence::InTurn,
        movement: Movement::None,
        counts_as: CountsAs::Setting,
        duty: CrewDuty::Sensors,
        unsuited: &[],
    },
    scope: Scope::Everywhere,
    aliases: &["look"],
    examples: &["roi 50.4501 30.5234 up 2", "all roi off"],
    forms: &[
        Form::new(
            &[
                Argument::value("point", Kind::Point, "argument-place"),
                Argument::keyed(
                    "up",
                    "up",
                    Kind::Number(Unit::Metres, -1000.0, 10_000.0),
                    "argument-roi-height",
                )
                .optional(),
            ],
            |given| {
                let up_m = given.number("up").unwrap_or(0.0);
                command(Command::Motion(MotionCommand::RegionOfInterest {
                    target: Some((given.required_point("point")?, up_m)),
                }))
            },
        ),
        Form::new(&[Argument::flag("off", "argument-roi-off")], |_| {
            command(Command::Motion(MotionCommand::RegionOfInterest {
                target: None,
            }))
        }),
    ],
};

const HOME: VerbRow = VerbRow {
    verb: setting("home"),
    scope: Scope::Everywhere,
    aliases: &["sethome"],
    examples: &["home here", "home 50.4501 30.5234 180"],
    forms: &[
        Form::new(&[Argument::flag("here", "argument-here")], |_| {
            command(Command::Motion(MotionCommand::SetHome { place: None }))
        }),
        Form::new(
            &[
                Argument::value("point", Kind::Point, "argument-place"),
                Argument::value(
                    "altitude",
                    Kind::Number(Unit::Metres, -500.0, 9000.0),
                    "argument-above-sea",
                ),
            ],
            |given| {
                let place = (given.required_point("point")?, given.required("altitude")?);
                command(Command::Motion(MotionCommand::SetHome {
                    place: Some(place),
                }))
            },
        ),
    ],
};
