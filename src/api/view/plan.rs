//! The plan on board a vehicle as programs see it.

use serde::Serialize;
use utoipa::ToSchema;

use crate::commands::command_name;
use crate::vehicle::{Plan, Transfer, Vehicle, VehicleId};

/// The plan on board a vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct PlanView {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<u64>,
    pub vehicle: VehicleId,
    /// Whether the plan has been read to its end, and no newer version is being read.
    pub complete: bool,
    /// The items after home, from number 1.
    pub items: Vec<PlanItemView>,
}

/// An item of the plan on board.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct PlanItemView {
    pub number: usize,
    /// The name of its `MAV_CMD`, or its number if the dialect has no name for it.
    pub command: String,
    /// The number of its `MAV_FRAME`.
    pub frame: u8,
    /// The first four parameters; `null` where a parameter is not set.
    #[schema(value_type = Vec<Option<f32>>)]
    pub params: [Option<f32>; 4],
    pub lat_deg: Option<f64>,
    pub lon_deg: Option<f64>,
    /// Metres above the reference of the frame, or the seventh parameter.
    pub z: f32,
}

impl PlanView {
    pub(in crate::api) fn new(id: Option<u64>, vehicle: &Vehicle) -> Self {
        let stored = &vehicle.plans.plan;
        let plan = stored.content.as_deref();
        Self {
            id,
            vehicle: vehicle.id,
            complete: stored.transfer == Transfer::Done,
            items: plan.map(items).unwrap_or_default(),
        }
    }
}

fn items(plan: &Plan) -> Vec<PlanItemView> {
    let first = plan.items.len() - plan.flown().len();
    let flown = plan.flown().iter().enumerate();
    flown
        .map(|(after_first, item)| {
            let place = item.place();
            PlanItemView {
                number: first + after_first,
                command: command_name(item.command)
                    .map_or_else(|| item.command.to_string(), str::to_owned),
                frame: item.frame,
                params: item.params.map(|value| (!value.is_nan()).then_some(value)),
                lat_deg: place.map(|at| at.lat_deg),
                lon_deg: place.map(|at| at.lon_deg),
                z: item.z,
            }
        })
        .collect()
}
