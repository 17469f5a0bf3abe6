//! The vehicles' trails and targets.

use super::canvas::{Canvas, Stroke};
use super::labels::{Label, LabelKind};
use crate::app::State;
use crate::app::room::map::{leg, shows_leg};
use crate::comparison::TrackPoint;
use crate::config::Symbols;
use crate::geo::maths;
use crate::geo::{Dot, Viewport};
use crate::ui::look::{Badge, Look};
use crate::ui::theme::Role;
use crate::vehicle::{Vehicle, VehicleId};

/// In a swarm larger than this, only the vehicle under the cursor and the selected ones have trails
/// and targets.
const MANY: usize = 64;
/// The number of dots between two vehicle numbers on a trail, if all trails have the same colour.
const NUMBER_EVERY: f64 = 24.0;
/// The number of dots after which a trail outside a narrow view is no longer followed.
const FAR: f64 = 10_000.0;

/// The stroke of a vehicle's trail.
pub fn trail(vehicle: VehicleId) -> Stroke {
    Stroke::solid(Badge::of_vehicle(vehicle).role)
}

/// The stroke to a vehicle's target.
pub fn target(vehicle: VehicleId) -> Stroke {
    Stroke::dashed(Badge::of_vehicle(vehicle).role)
}

/// Draws trails; if their colours do not differ, with the vehicle's number at intervals.
pub fn draw_trails(
    state: &State,
    look: &Look,
    view: &Viewport,
    canvas: &mut Canvas,
    labels: &mut Vec<Label>,
) {
    let map = state.rooms().map();
    if map.hides_trails() {
        return;
    }
    let is_numbered = state.session().vehicles().len() > 1 && !tells_by_colour(look);
    let mut numbers = Vec::new();
    for vehicle in shown(state) {
        let Some(trail) = map.trails().get(&vehicle.id) else {
            continue;
        };
        let stroke = self::trail(vehicle.id);
        let dots: Vec<Dot> = trail.points().iter().map(|&it| view.dot(it)).collect();
        for pair in dots.windows(2) {
            canvas.line(pair[0], pair[1], stroke);
        }
        if is_numbered {
            let places = along(&dots).into_iter().map(|dot| view.place(dot));
            numbers.extend(places.filter_map(|at| view.cell(at)).map(|cell| Label {
                cell,
                kind: LabelKind::Number,
                text: vehicle.id.to_string(),
                role: stroke.role,
            }));
        }
    }
    // The first labels are dropped if there is no room for all.
    labels.splice(0..0, numbers);
}

/// Draws the lines to the vehicles' targets.
pub fn draw_targets(state: &State, view: &Viewport, canvas: &mut Canvas, labels: &mut Vec<Label>) {
    for vehicle in shown(state) {
        let Some((from, to)) = leg(vehicle).filter(|_| !shows_leg(state, vehicle)) else {
            continue;
        };
        // The line begins at the target, so that the dashes stay in place, and ends at the vehicle's cell.
        let here = view.cell(from).map_or(from, |(column, row)| {
            view.middle_of(i32::from(column), i32::from(row))
        });
        let stroke = target(vehicle.id);
        canvas.line(view.dot(to), view.dot(here), stroke);
        labels.extend(view.cell(to).map(|cell| Label {
            cell,
            kind: LabelKind::Word,
            text: "x".to_owned(),
            role: stroke.role,
        }));
    }
}

/// The stroke of the other flight's trails beside those of this one.
pub const GHOST: Stroke = Stroke::dotted(Role::Muted);

/// Draws the trails of the other flight so far; returns its vehicles with a `g` before their numbers.
pub fn draw_ghost(state: &State, view: &Viewport, canvas: &mut Canvas) -> Vec<Label> {
    let (Some(ghost), Some(time)) = (state.ghost(), state.ghost_time()) else {
        return Vec::new();
    };
    if !state.rooms().map().hides_trails() {
        for way in ghost.other.ways(time) {
            for pair in way.windows(2) {
                canvas.line(view.dot(pair[0]), view.dot(pair[1]), GHOST);
            }
        }
    }
    let places = ghost.other.at(time);
    let label = |(vehicle, point): (_, TrackPoint)| {
        Some(Label {
            cell: view.cell(point.place)?,
            kind: LabelKind::Word,
            text: format!("g{vehicle}"),
            role: Role::Muted,
        })
    };
    places.filter_map(label).collect()
}

/// The vehicles with trails.
fn shown(state: &State) -> impl Iterator<Item = &Vehicle> {
    let session = state.session();
    let many = session.vehicles().len() > MANY;
    let is_chosen =
        move |id: VehicleId| session.cursor() == Some(id) || session.selection().contains(&id);
    let vehicles = session.vehicles().values().map(AsRef::as_ref);
    vehicles
        .filter(move |it: &&Vehicle| !many || is_chosen(it.id))
        .take(MANY)
}

/// The points along a trail at which its numbers are written, from its start.
fn along(dots: &[Dot]) -> Vec<Dot> {
    let mut found = Vec::new();
    let mut left = NUMBER_EVERY / 2.0;
    for pair in dots.windows(2) {
        let length = maths::hypot(pair[1].x - pair[0].x, pair[1].y - pair[0].y);
        if !length.is_finite() || length > FAR {
            continue;
        }
        while left < length {
            found.push(pair[0].towards(pair[1], left / length));
            left += NUMBER_EVERY;
        }
        left -= length;
    }
    found
}

/// Whether the trails of two vehicles differ in colour.
pub fn tells_by_colour(look: &Look) -> bool {
    let [first, second] = [1, 2].map(|id| look.style(Badge::of_vehicle(id).role));
    look.symbols != Symbols::Ascii && first != second
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_at_intervals_along_a_trail() {
        let way = |points: &[f64]| -> Vec<Dot> {
            let dots = points.iter().map(|&x| Dot::new(x, 0.0));
            dots.collect()
        };
        let at =
            |points: &[f64]| -> Vec<f64> { along(&way(points)).iter().map(|dot| dot.x).collect() };
        assert_eq!(at(&[0.0, 70.0]), [12.0, 36.0, 60.0]);
        assert_eq!(at(&[0.0, 10.0, 20.0, 40.0]), [12.0, 36.0]);
        assert_eq!(at(&[0.0, 5.0, 0.0, 5.0]), [2.0]);
        assert!(at(&[0.0, 1e12, f64::NAN]).is_empty());
        assert!(at(&[]).is_empty());
    }
}
