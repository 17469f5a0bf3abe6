//! Whether the plans on board, without their faults, stay inside the fences.

use super::Examined;
use crate::text;

pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let ceiling_m = examined.ceiling_m();
    let Some(section) = examined.section("board") else {
        return;
    };
    for (route, written) in mission.board.routes.iter().zip(section.items_of("plans")) {
        if route.up_m > ceiling_m {
            let fault = text!("check-plan-high", height = ceiling_m.to_string());
            examined.add(written.span_of("up"), fault);
        }
        for (index, &at) in route.points.iter().enumerate() {
            let fence = mission.fences().find(|fence| !fence.shape.contains(at));
            if let Some(fence) = fence {
                let fault = text!("check-place-fence", fence = &fence.id);
                examined.add(written.span_of_item("places", index), fault);
            }
        }
    }
}
