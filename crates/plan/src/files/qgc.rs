//! QGroundControl's `.plan`: file version 1, mission 2, fence 1 and 2, rally points 1 and 2.
//!
//! The format cannot hold the frame and height of fence items (they have no meaning) or the order
//! of areas of different kinds. Rally points whose heights are not above home are refused.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Parsed;
use super::json::Node;
use super::number::{decimals, decimals_of};
use crate::fault::{Expected, Fault, FaultKind, NoteKind, Unwritable};
use crate::{Document, HeightFrame, Home, Item, ListKind, Origin, command, frame};

mod fence;

/// Whether a document is in this format.
pub(super) fn is_plan(root: &Node) -> bool {
    root.get("fileType").is_some() || root.get("mission").is_some()
}

pub(super) fn parse(root: &Node) -> Result<Parsed, Vec<Fault>> {
    let mut parsed = Parsed::default();
    let read = [
        head(root),
        root.need("mission")
            .and_then(|mission| read_mission(mission, &mut parsed)),
        root.get("geoFence")
            .map_or(Ok(()), |node| fence::read(node, &mut parsed)),
        root.get("rallyPoints")
            .map_or(Ok(()), |node| read_rally(node, &mut parsed)),
    ];
    let faults: Vec<Fault> = read.into_iter().filter_map(Result::err).collect();
    if faults.is_empty() {
        Ok(parsed)
    } else {
        Err(faults)
    }
}

fn head(root: &Node) -> Result<(), Fault> {
    let kind = root.need("fileType")?;
    if kind.text()? != "Plan" {
        return Err(Fault::new(
            kind.span.clone(),
            FaultKind::Expected(Expected::Word("Plan")),
        ));
    }
    check_version(root, &[1], "1").map(drop)
}

fn check_version(node: &Node, known: &[u32], listed: &'static str) -> Result<u32, Fault> {
    let version = node.need("version")?;
    let number = version.number()?;
    let whole: Option<u32> = super::number::whole(number);
    if let Some(number) = whole.filter(|number| known.contains(number)) {
        return Ok(number);
    }
    let found = number.to_string();
    let kind = FaultKind::Version {
        found,
        known: listed,
    };
    Err(Fault::new(version.span.clone(), kind))
}

fn read_mission(mission: &Node, parsed: &mut Parsed) -> Result<(), Fault> {
    check_version(mission, &[2], "2")?;
    if let Some(node) = mission.get("plannedHomePosition") {
        let [lat, lon, height] = node.array::<3>()?;
        let (x, y, z) = (
            lat.fixed(7)?,
            lon.fixed(7)?,
            height.number_or_null()? as f32,
        );
        if (x, y) != (0, 0) || z.abs() > 0.0 {
            parsed.set_home(Home { x, y, z }, node.span.clone());
        }
    }
    parsed.document.origin = Some(read_origin(mission)?);
    // Ids of items and their numbers in the plan.
    let mut numbers = BTreeMap::new();
    for node in mission.need("items")?.list()? {
        match node.need("type")?.text()? {
            "SimpleItem" => read_item(node, parsed, &mut numbers)?,
            "ComplexItem" => {
                for inner in embedded(node)? {
                    read_item(inner, parsed, &mut numbers)?;
                }
            }
            _ => {
                let span = node.need("type")?.span.clone();
                let kind = FaultKind::Expected(Expected::Word("SimpleItem, ComplexItem"));
                return Err(Fault::new(span, kind));
            }
        }
    }
    aim_jumps(parsed, &numbers)
}

fn read_origin(mission: &Node) -> Result<Origin, Fault> {
    let usual = Origin::default();
    let whole = |key, usual| mission.get(key).map_or(Ok(usual), Node::whole);
    let speed = |key, usual| {
        let read = |node: &Node| node.number_or_null().map(|speed| speed as f32);
        mission.get(key).map_or(Ok(usual), read)
    };
    Ok(Origin {
        firmware: whole("firmwareType", usual.firmware)?,
        vehicle: whole("vehicleType", usual.vehicle)?,
        cruise_speed_m_s: speed("cruiseSpeed", usual.cruise_speed_m_s)?,
        hover_speed_m_s: speed("hoverSpeed", usual.hover_speed_m_s)?,
    })
}

/// The simple items of a complex item, such as a survey.
fn embedded(node: &Node) -> Result<&[Node], Fault> {
    let inner = node.get("TransectStyleComplexItem").unwrap_or(node);
    if let Some(items) = inner.get("Items") {
        return items.list();
    }
    let name = node.get("complexItemType");
    let written = name.and_then(|name| name.text().ok()).unwrap_or_default();
    let start = node.span.start..node.span.start + 1;
    let span = name.map_or(start, |name| name.span.clone());
    Err(Fault::new(
        span,
        FaultKind::NoEmbeddedItems(written.to_owned()),
    ))
}

fn read_item(
    node: &Node,
    parsed: &mut Parsed,
    numbers: &mut BTreeMap<u32, usize>,
) -> Result<(), Fault> {
    let [p1, p2, p3, p4, x, y, z] = node.need("params")?.array::<7>()?;
    let (command, frame) = (node.need("command")?.whole()?, node.need("frame")?.whole()?);
    let places = decimals(command, frame);
    let param = |node: &Node| node.number_or_null().map(|number| number as f32);
    let has_fraction = |node: &Node| node.number().is_ok_and(|number| number.fract().abs() > 0.0);
    if places == 0 && (has_fraction(x) || has_fraction(y)) {
        parsed.note(ListKind::Plan, &x.span, NoteKind::FractionLost);
    }
    let item = Item {
        command,
        frame,
        auto_continue: node.get("autoContinue").map_or(Ok(true), Node::flag)?,
        params: [param(p1)?, param(p2)?, param(p3)?, param(p4)?],
        x: x.fixed(places)?,
        y: y.fixed(places)?,
        z: param(z)?,
    };
    parsed.push(ListKind::Plan, item, node.span.clone());
    if let Some(id) = node.get("doJumpId") {
        numbers.insert(id.whole()?, parsed.document.plan.len());
    }
    Ok(())
}

/// Converts jump targets from item ids, as in the file, to item numbers, as in MAVLink.
fn aim_jumps(parsed: &mut Parsed, numbers: &BTreeMap<u32, usize>) -> Result<(), Fault> {
    if numbers.iter().all(|(id, number)| *id as usize == *number) {
        return Ok(());
    }
    for (index, item) in parsed.document.plan.iter_mut().enumerate() {
        if item.command != command::DO_JUMP {
            continue;
        }
        let id = item.params[0] as u32;
        let Some(number) = numbers.get(&id) else {
            let span = parsed.places.item(ListKind::Plan, index);
            return Err(Fault::new(
                span.unwrap_or_default(),
                FaultKind::UnknownJump(id),
            ));
        };
        item.params[0] = *number as f32;
    }
    Ok(())
}

fn read_rally(node: &Node, parsed: &mut Parsed) -> Result<(), Fault> {
    check_version(node, &[1, 2], "1, 2")?;
    for point in node.need("points")?.list()? {
        let [lat, lon, height] = point.array::<3>()?;
        let item = Item {
            command: command::RALLY_POINT,
            frame: frame::ABOVE_HOME,
            auto_continue: true,
            params: [0.0; 4],
            x: lat.fixed(7)?,
            y: lon.fixed(7)?,
            z: height.number_or_null()? as f32,
        };
        parsed.push(ListKind::Rally, item, point.span.clone());
    }
    Ok(())
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct PlanFile {
    file_type: &'static str,
    geo_fence: fence::FenceBlock,
    ground_station: &'static str,
    mission: MissionBlock,
    rally_points: RallyBlock,
    version: u8,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct MissionBlock {
    cruise_speed: f32,
    firmware_type: u8,
    global_plan_altitude_mode: u8,
    hover_speed: f32,
    items: Vec<SimpleItem>,
    planned_home_position: (f64, f64, f32),
    vehicle_type: u8,
    version: u8,
}

#[derive(Serialize)]
struct SimpleItem {
    #[serde(flatten)]
    height: Option<HeightFields>,
    #[serde(rename = "autoContinue")]
    auto_continue: bool,
    command: u16,
    #[serde(rename = "doJumpId")]
    do_jump_id: usize,
    frame: u8,
    params: (f32, f32, f32, f32, f64, f64, f32),
    #[serde(rename = "type")]
    kind: &'static str,
}

/// The fields of a height that QGroundControl's editor shows.
#[derive(Serialize)]
struct HeightFields {
    #[serde(rename = "AMSLAltAboveTerrain")]
    above_terrain: Option<f32>,
    #[serde(rename = "Altitude")]
    altitude: f32,
    #[serde(rename = "AltitudeMode")]
    mode: u8,
}

#[derive(Serialize)]
struct RallyBlock {
    points: Vec<(f64, f64, f32)>,
    version: u8,
}

/// Writes all lists.
///
/// # Errors
/// See [`Unwritable`].
pub(super) fn write(document: &Document) -> Result<String, Unwritable> {
    refuse_infinite(document)?;
    let origin = document.origin.unwrap_or_default();
    let home = document.home.unwrap_or(Home { x: 0, y: 0, z: 0.0 });
    let items = document.plan.iter().enumerate();
    let file = PlanFile {
        file_type: "Plan",
        geo_fence: fence::block(&document.fence)?,
        ground_station: "sortie",
        mission: MissionBlock {
            cruise_speed: origin.cruise_speed_m_s,
            firmware_type: origin.firmware,
            // The editor's setting for new items: heights above home.
            global_plan_altitude_mode: 1,
            hover_speed: origin.hover_speed_m_s,
            items: items
                .map(|(index, item)| simple_item(item, index + 1))
                .collect(),
            planned_home_position: (degrees(home.x), degrees(home.y), home.z),
            vehicle_type: origin.vehicle,
            version: 2,
        },
        rally_points: RallyBlock {
            points: rally_points(&document.rally)?,
            version: 2,
        },
        version: 1,
    };
    let text = serde_json::to_string_pretty(&file).unwrap_or_default();
    Ok(text + "\n")
}

pub(super) fn refuse_infinite(document: &Document) -> Result<(), Unwritable> {
    for kind in ListKind::ALL {
        for (index, item) in document.list(kind).iter().enumerate() {
            if item.z.is_infinite() || item.params.iter().any(|param| param.is_infinite()) {
                return Err(Unwritable::Infinite(kind, index));
            }
        }
    }
    Ok(())
}

fn simple_item(item: &Item, id: usize) -> SimpleItem {
    let scale = f64::from(10_i32.pow(decimals_of(item)));
    let [p1, p2, p3, p4] = item.params;
    let (x, y) = (f64::from(item.x) / scale, f64::from(item.y) / scale);
    let mode = match item.height_frame() {
        HeightFrame::Home => Some(1),
        HeightFrame::SeaLevel => Some(2),
        HeightFrame::Terrain => Some(4),
        HeightFrame::Other => None,
    };
    let mode = mode.filter(|_| command::has_place(item.command));
    SimpleItem {
        height: mode.map(|mode| HeightFields {
            above_terrain: None,
            altitude: item.z,
            mode,
        }),
        auto_continue: item.auto_continue,
        command: item.command,
        do_jump_id: id,
        frame: item.frame,
        params: (p1, p2, p3, p4, x, y, item.z),
        kind: "SimpleItem",
    }
}

fn rally_points(items: &[Item]) -> Result<Vec<(f64, f64, f32)>, Unwritable> {
    let points = items.iter().enumerate().map(|(index, item)| {
        if item.command != command::RALLY_POINT || item.height_frame() != HeightFrame::Home {
            return Err(Unwritable::RallyFrame(index));
        }
        Ok((degrees(item.x), degrees(item.y), item.z))
    });
    points.collect()
}

fn degrees(e7: i32) -> f64 {
    f64::from(e7) / 1e7
}
