//! The forms of `draft` that add areas to the fence, and rally points.

use super::{Built, EAST, ITEM, NORTH, POINT, UP, edit, height_m, here, number, says};
use crate::draft::{Edit, FenceEdit, Spot};
use crate::geo::{LatLon, Outline};
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::verb::Form;

const OUT: Argument = Argument::flag("out", "argument-draft-out").optional();
const FENCE: Argument = Argument::flag("fence", "argument-draft-fence");
const RADIUS_KIND: Kind = Kind::Number(Unit::Metres, 1.0, 100_000.0);

pub(super) const FORMS: &[Form] = &[
    Form::new(
        &[
            FENCE,
            says("corner", "argument-draft-corner"),
            POINT,
            NORTH,
            EAST,
        ],
        |given| {
            edit(Edit::Fence(FenceEdit::Corner {
                spot: here(given),
                after: None,
            }))
        },
    ),
    Form::new(
        &[
            FENCE,
            says("polygon", "argument-draft-polygon"),
            OUT,
            POINT,
            NORTH,
            EAST,
        ],
        |given| {
            edit(Edit::Fence(FenceEdit::Polygon {
                keeps_in: !given.flag("out"),
                corners: vec![here(given)],
            }))
        },
    ),
    Form::new(
        &[
            FENCE,
            says("area", "argument-draft-area"),
            Argument::value("name", Kind::Area, "argument-draft-area"),
            OUT,
        ],
        area,
    ),
    Form::new(
        &[
            FENCE,
            says("circle", "argument-draft-circle"),
            Argument::value("radius", RADIUS_KIND, "argument-draft-radius"),
            OUT,
            POINT,
            NORTH,
            EAST,
        ],
        |given| {
            edit(Edit::Fence(FenceEdit::Circle {
                keeps_in: !given.flag("out"),
                spot: here(given),
                radius_m: given.required("radius")? as f32,
            }))
        },
    ),
    Form::new(
        &[FENCE, says("reverse", "argument-draft-reverse"), ITEM],
        |given| edit(Edit::Fence(FenceEdit::Flip(number(given, "item")?))),
    ),
    Form::new(
        &[
            says("rally", "argument-draft-rally"),
            POINT,
            NORTH,
            EAST,
            UP,
        ],
        |given| {
            edit(Edit::Rally {
                spot: here(given),
                height_m: height_m(given),
            })
        },
    ),
];

fn area(given: &Arguments) -> Built {
    let keeps_in = !given.flag("out");
    match given.required_area("name")? {
        Outline::Polygon(corners) => edit(Edit::Fence(FenceEdit::Polygon {
            keeps_in,
            corners: corners.iter().copied().map(Spot::At).collect(),
        })),
        Outline::Circle { centre, radius_m } => circle(keeps_in, *centre, *radius_m),
    }
}

fn circle(keeps_in: bool, centre: LatLon, radius_m: f64) -> Built {
    edit(Edit::Fence(FenceEdit::Circle {
        keeps_in,
        spot: Spot::At(centre),
        radius_m: radius_m as f32,
    }))
}
