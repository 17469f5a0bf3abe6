//! The areas of a fence as the vehicle checks them.

use glam::DVec2;
use mavlink::dialects::ardupilotmega::MavSeverity;

use crate::plan::Item;
use sortie_geo::LatLon;
pub(crate) use sortie_plan::{AreaShape, FenceArea, FenceError, is_inside};

#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Fence(sortie_plan::Fence);

/// The severity of the vehicle's message about an invalid fence.
pub(crate) fn severity(error: FenceError) -> MavSeverity {
    match error {
        FenceError::ItemCount => MavSeverity::MAV_SEVERITY_INFO,
        FenceError::VertexCount(_)
        | FenceError::OtherCount { .. }
        | FenceError::OtherVertex { .. }
        | FenceError::OtherType { .. }
        | FenceError::Radius
        | FenceError::ReturnPoints
        | FenceError::Place => MavSeverity::MAV_SEVERITY_WARNING,
    }
}

impl Fence {
    /// Builds a fence from an uploaded list.
    ///
    /// # Errors
    /// The fault of the first invalid item, in the vehicle's order.
    pub(crate) fn check(items: &[Item]) -> Result<Self, FenceError> {
        let checked = sortie_plan::Fence::check(items);
        checked.map(Self).map_err(|(_, error)| error)
    }

    /// The areas in metres north and east of a place, polygons first and inclusions before exclusions: the order in
    /// which the vehicle checks them.
    pub(crate) fn in_metres(&self, from: LatLon) -> Vec<FenceArea<DVec2>> {
        let metres = |point: &LatLon| {
            let (north, east) = from.offset_to(*point);
            DVec2::new(north, east)
        };
        let mut areas: Vec<_> = self.0.areas.iter().map(|area| area.map(metres)).collect();
        areas.sort_by_key(|area| {
            (
                matches!(area.shape, AreaShape::Circle { .. }),
                !area.keeps_in,
            )
        });
        areas
    }
}
