//! The common part of KML and `GeoJSON`: features with a geometry and data.
//!
//! Features of other programs are shapes: lines become the plan, polygons the fence, points rally points. Features
//! written by this program have every field of an item as data; the key `sortie` names the list. Drawings are only for
//! display.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use super::number::{decimals, decimals_of, fixed, unfixed, whole};
use super::{Parsed, ReadOptions};
use crate::fault::{Expected, Fault, FaultKind, NoteKind};
use crate::{Document, Home, Item, ListKind, command, frame};

/// The key whose value is the kind of a feature written by this program.
const KIND: &str = "sortie";
const PARAMS: [&str; 4] = ["param1", "param2", "param3", "param4"];

/// A place in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Position {
    pub(super) lat: f64,
    pub(super) lon: f64,
    pub(super) height_m: Option<f64>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Geometry {
    Point(Position),
    Line(Vec<Position>),
    /// The outline, then the holes. The last corner repeats the first.
    Polygon(Vec<Vec<Position>>),
}

/// The reference of the heights of a geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Heights {
    SeaLevel,
    Terrain,
    /// The geometry has no heights.
    Unset,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    pub(super) geometry: Geometry,
    pub(super) heights: Heights,
    pub(super) span: Range<usize>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Feature {
    pub(super) shapes: Vec<Shape>,
    pub(super) data: BTreeMap<String, (String, Range<usize>)>,
    pub(super) span: Range<usize>,
}

pub(super) fn document(features: &[Feature], options: ReadOptions) -> Result<Parsed, Vec<Fault>> {
    let mut reader = Reader {
        parsed: Parsed::default(),
        options,
        lines: 0,
    };
    let taken = features.iter().map(|feature| reader.take(feature));
    let faults: Vec<Fault> = taken.filter_map(Result::err).collect();
    if !faults.is_empty() {
        return Err(faults);
    }
    if reader.lines > 1 {
        let span = reader
            .parsed
            .places
            .item(ListKind::Plan, 0)
            .unwrap_or_default();
        reader
            .parsed
            .note(ListKind::Plan, &span, NoteKind::LinesJoined(reader.lines));
    }
    Ok(reader.parsed)
}

struct Reader {
    parsed: Parsed,
    options: ReadOptions,
    lines: usize,
}

impl Reader {
    fn take(&mut self, feature: &Feature) -> Result<(), Fault> {
        let Some((kind, span)) = feature.data.get(KIND) else {
            return feature
                .shapes
                .iter()
                .try_for_each(|shape| self.take_shape(shape));
        };
        let list = match kind.as_str() {
            "drawing" => return Ok(()),
            "home" => return self.take_home(feature),
            "plan" => ListKind::Plan,
            "fence" => ListKind::Fence,
            "rally" => ListKind::Rally,
            _ => {
                let words = Expected::Word("plan, fence, rally, home, drawing");
                return Err(Fault::new(span.clone(), FaultKind::Expected(words)));
            }
        };
        let item = feature.item()?;
        self.parsed.push(list, item, feature.span.clone());
        Ok(())
    }

    fn take_home(&mut self, feature: &Feature) -> Result<(), Fault> {
        let (x, y) = feature.point()?;
        let z = feature.number("z")? as f32;
        self.parsed.set_home(Home { x, y, z }, feature.span.clone());
        Ok(())
    }

    fn take_shape(&mut self, shape: &Shape) -> Result<(), Fault> {
        match &shape.geometry {
            Geometry::Point(at) => {
                let item = self.item(shape, command::RALLY_POINT, at)?;
                self.parsed.push(ListKind::Rally, item, shape.span.clone());
                self.note_heights(ListKind::Rally, shape, std::slice::from_ref(at));
            }
            Geometry::Line(points) => {
                if points.len() < 2 {
                    return Err(Fault::new(shape.span.clone(), FaultKind::ShortLine));
                }
                for at in points {
                    let item = self.item(shape, command::WAYPOINT, at)?;
                    self.parsed.push(ListKind::Plan, item, shape.span.clone());
                }
                self.lines += 1;
                self.note_heights(ListKind::Plan, shape, points);
            }
            Geometry::Polygon(rings) => {
                for (index, ring) in rings.iter().enumerate() {
                    let keeps_in = self.options.polygons_keep_in == (index == 0);
                    self.take_ring(shape, ring, keeps_in)?;
                }
            }
        }
        Ok(())
    }

    fn note_heights(&mut self, list: ListKind, shape: &Shape, points: &[Position]) {
        if points.iter().any(|at| height(shape, at).is_none()) {
            let assumed = NoteKind::HeightAssumed(self.options.height_m);
            self.parsed.note(list, &shape.span, assumed);
        }
    }

    fn item(&self, shape: &Shape, command: u16, at: &Position) -> Result<Item, Fault> {
        let (x, y) = valid(at, &shape.span)?;
        let (frame, z) = height(shape, at).unwrap_or((frame::ABOVE_HOME, self.options.height_m));
        Ok(Item {
            command,
            frame,
            auto_continue: true,
            x,
            y,
            z,
            ..Item::default()
        })
    }

    fn take_ring(&mut self, shape: &Shape, ring: &[Position], keeps_in: bool) -> Result<(), Fault> {
        let mut corners = Vec::new();
        for at in ring {
            corners.push(valid(at, &shape.span)?);
        }
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() < 3 {
            return Err(Fault::new(
                shape.span.clone(),
                FaultKind::FewCorners(corners.len()),
            ));
        }
        let command = if keeps_in {
            command::FENCE_POLYGON_INCLUSION
        } else {
            command::FENCE_POLYGON_EXCLUSION
        };
        let count = corners.len() as f32;
        for (x, y) in corners {
            let item = Item::of_fence(command, count, x, y);
            self.parsed.push(ListKind::Fence, item, shape.span.clone());
        }
        Ok(())
    }
}

/// The frame and height of a place, if it has a height with a known reference.
fn height(shape: &Shape, at: &Position) -> Option<(u8, f32)> {
    let height_m = at.height_m? as f32;
    match shape.heights {
        Heights::SeaLevel => Some((frame::SEA_LEVEL, height_m)),
        Heights::Terrain => Some((frame::ABOVE_TERRAIN, height_m)),
        Heights::Unset => None,
    }
}

fn valid(at: &Position, span: &Range<usize>) -> Result<(i32, i32), Fault> {
    let is_valid = at.lat.abs() <= 90.0 && at.lon.abs() <= 180.0;
    let place = fixed(at.lat, 7).zip(fixed(at.lon, 7));
    place.filter(|_| is_valid).ok_or_else(|| {
        let written = format!("{}, {}", at.lat, at.lon);
        Fault::new(span.clone(), FaultKind::OutOfRange(written))
    })
}

impl Feature {
    fn word(&self, key: &'static str) -> Result<&(String, Range<usize>), Fault> {
        let start = self.span.start..self.span.start + 1;
        self.data
            .get(key)
            .ok_or_else(|| Fault::new(start, FaultKind::Missing(key)))
    }

    fn number(&self, key: &'static str) -> Result<f64, Fault> {
        let (text, span) = self.word(key)?;
        let not_a_number = || Fault::new(span.clone(), FaultKind::NotANumber(text.clone()));
        text.trim().parse().map_err(|_| not_a_number())
    }

    fn whole<T: TryFrom<i64>>(&self, key: &'static str) -> Result<T, Fault> {
        let number = self.number(key)?;
        whole(number).ok_or_else(|| self.out_of_range(key))
    }

    fn out_of_range(&self, key: &'static str) -> Fault {
        let (text, span) = self.data.get(key).cloned().unwrap_or_default();
        Fault::new(span, FaultKind::OutOfRange(text))
    }

    /// The place of the feature's point, in 1e-7 degrees.
    fn point(&self) -> Result<(i32, i32), Fault> {
        let found = self.shapes.iter().find_map(|shape| match &shape.geometry {
            Geometry::Point(at) => Some((at, &shape.span)),
            Geometry::Line(_) | Geometry::Polygon(_) => None,
        });
        let Some((at, span)) = found else {
            let start = self.span.start..self.span.start + 1;
            return Err(Fault::new(start, FaultKind::Expected(Expected::Position)));
        };
        let place = fixed(at.lat, 7).zip(fixed(at.lon, 7));
        place.ok_or_else(|| {
            let written = format!("{}, {}", at.lat, at.lon);
            Fault::new(span.clone(), FaultKind::OutOfRange(written))
        })
    }

    fn item(&self) -> Result<Item, Fault> {
        let (command, frame) = (self.whole("command")?, self.whole("frame")?);
        let [p1, p2, p3, p4] = PARAMS.map(|key| self.number(key).map(|number| number as f32));
        let (x, y) = if decimals(command, frame) == 7 {
            self.point()?
        } else {
            (self.whole("x")?, self.whole("y")?)
        };
        Ok(Item {
            command,
            frame,
            auto_continue: self.whole::<u8>("autoContinue")? != 0,
            params: [p1?, p2?, p3?, p4?],
            x,
            y,
            z: self.number("z")? as f32,
        })
    }
}

/// A value in the data of a feature to write.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Datum {
    Word(&'static str),
    Whole(i64),
    Real(f32),
}

impl fmt::Display for Datum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => f.write_str(word),
            Self::Whole(number) => number.fmt(f),
            Self::Real(number) if number.is_nan() => f.write_str("nan"),
            Self::Real(number) => number.fmt(f),
        }
    }
}

/// A place to write: longitude and latitude in 1e-7 degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Spot {
    pub(super) x: i32,
    pub(super) y: i32,
}

impl Spot {
    /// Longitude and latitude in degrees, exactly.
    pub(super) fn words(self) -> [String; 2] {
        [unfixed(self.y, 7), unfixed(self.x, 7)]
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outline {
    Nothing,
    Point(Spot),
    Line(Vec<Spot>),
    Ring(Vec<Spot>),
}

/// A feature to write.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drawn {
    pub(super) name: String,
    pub(super) data: Vec<(&'static str, Datum)>,
    pub(super) outline: Outline,
}

/// A document as features: drawings of the path and the areas, home, and every item.
pub(super) fn features(document: &Document) -> Vec<Drawn> {
    let mut features = drawings(document);
    if let Some(Home { x, y, z }) = document.home {
        features.push(Drawn {
            name: "home".to_owned(),
            data: vec![(KIND, Datum::Word("home")), ("z", Datum::Real(z))],
            outline: Outline::Point(Spot { x, y }),
        });
    }
    for (kind, word) in ListKind::ALL.into_iter().zip(["plan", "fence", "rally"]) {
        let items = document.list(kind).iter().enumerate();
        features.extend(items.map(|(index, item)| Drawn {
            name: format!("{word} {}", index + 1),
            data: data_of(word, item),
            outline: if decimals_of(item) == 7 {
                Outline::Point(spot(item))
            } else {
                Outline::Nothing
            },
        }));
    }
    features
}

fn spot(item: &Item) -> Spot {
    Spot {
        x: item.x,
        y: item.y,
    }
}

fn data_of(list: &'static str, item: &Item) -> Vec<(&'static str, Datum)> {
    let mut data = vec![
        (KIND, Datum::Word(list)),
        ("command", Datum::Whole(item.command.into())),
        ("frame", Datum::Whole(item.frame.into())),
        ("autoContinue", Datum::Whole(item.auto_continue.into())),
        ("z", Datum::Real(item.z)),
    ];
    data.extend(PARAMS.into_iter().zip(item.params.map(Datum::Real)));
    if decimals_of(item) != 7 {
        data.push(("x", Datum::Whole(item.x.into())));
        data.push(("y", Datum::Whole(item.y.into())));
    }
    data
}

fn drawings(document: &Document) -> Vec<Drawn> {
    let drawing = |name: &str, outline| Drawn {
        name: name.to_owned(),
        data: vec![(KIND, Datum::Word("drawing"))],
        outline,
    };
    let is_set = |item: &&Item| command::is_flown_to(item.command) && (item.x, item.y) != (0, 0);
    let path: Vec<Spot> = document.plan.iter().filter(is_set).map(spot).collect();
    let mut drawings = Vec::new();
    if path.len() > 1 {
        drawings.push(drawing("path", Outline::Line(path)));
    }
    let mut rest = document.fence.as_slice();
    while let Some(first) = rest.first() {
        let count = if command::is_corner(first.command) {
            first.params[0] as usize
        } else {
            1
        };
        let (area, further) = rest.split_at(count.clamp(1, rest.len()));
        if area.len() > 2 {
            drawings.push(drawing(
                "area",
                Outline::Ring(area.iter().map(spot).collect()),
            ));
        }
        rest = further;
    }
    drawings
}
