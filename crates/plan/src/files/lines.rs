//! MAVProxy's old fences and rally points: one point per line.

use super::Parsed;
use super::number::{Word, lines};
use crate::fault::{Fault, FaultKind};
use crate::{Item, ListKind, command, frame};

pub(super) fn is_rally(text: &str) -> bool {
    let first = lines(text).next();
    first.is_some_and(|words| words[0].text.eq_ignore_ascii_case("rally"))
}

/// Whether the first line consists of numbers.
pub(super) fn is_fence(text: &str) -> bool {
    let first = lines(text).next();
    first.is_some_and(|words| words.iter().all(|word| word.number().is_ok()))
}

/// Parses lines of the form `RALLY latitude longitude height break-height direction flags`. The
/// last three fields are for fixed-wing aircraft, and MAVLink's rally points lack them.
pub(super) fn parse_rally(text: &str) -> Result<Parsed, Vec<Fault>> {
    let mut parsed = Parsed::default();
    let mut faults = Vec::new();
    for words in lines(text) {
        match rally_point(&words) {
            Ok(item) => parsed.push(ListKind::Rally, item, span(&words)),
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() {
        Ok(parsed)
    } else {
        Err(faults)
    }
}

fn rally_point(words: &[Word<'_>]) -> Result<Item, Fault> {
    let wrong = || {
        let (found, expected) = (words.len(), 7);
        Fault::new(span(words), FaultKind::Fields { found, expected })
    };
    let [key, lat, lon, height, further @ ..] = words else {
        return Err(wrong());
    };
    if !key.text.eq_ignore_ascii_case("rally") || further.len() != 3 {
        return Err(wrong());
    }
    further
        .iter()
        .try_for_each(|word| word.number().map(drop))?;
    Ok(Item {
        command: command::RALLY_POINT,
        frame: frame::ABOVE_HOME,
        auto_continue: true,
        z: height.number()? as f32,
        x: lat.fixed(7)?,
        y: lon.fixed(7)?,
        ..Item::default()
    })
}

/// Parses the return point, then the corners of one inclusion area; the last corner repeats the
/// first. If the last point repeats the very first one, or there are only three points, all of them
/// are corners.
pub(super) fn parse_fence(text: &str) -> Result<Parsed, Vec<Fault>> {
    let mut points = Vec::new();
    let mut faults = Vec::new();
    for words in lines(text) {
        match fence_point(&words) {
            Ok(at) => points.push((at, span(&words))),
            Err(fault) => faults.push(fault),
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let is_ring_from = |first: usize| {
        let last = points.last().filter(|_| points.len() > first + 1);
        last.map(|it| it.0) == points.get(first).map(|it| it.0)
    };
    let has_return = is_ring_from(1) || !is_ring_from(0) && points.len() > 3;
    let first = usize::from(has_return);
    if is_ring_from(first) {
        points.pop();
    }
    let corners = points.len().saturating_sub(first);
    if corners < 3 {
        let span = points.last().map_or(0..0, |(_, span)| span.clone());
        return Err(vec![Fault::new(span, FaultKind::FewCorners(corners))]);
    }
    let mut parsed = Parsed::default();
    for (index, ((x, y), span)) in points.into_iter().enumerate() {
        let item = if index < first {
            Item::of_fence(command::FENCE_RETURN_POINT, 0.0, x, y)
        } else {
            Item::of_fence(command::FENCE_POLYGON_INCLUSION, corners as f32, x, y)
        };
        parsed.push(ListKind::Fence, item, span);
    }
    Ok(parsed)
}

fn fence_point(words: &[Word<'_>]) -> Result<(i32, i32), Fault> {
    let [lat, lon] = words else {
        let (found, expected) = (words.len(), 2);
        return Err(Fault::new(
            span(words),
            FaultKind::Fields { found, expected },
        ));
    };
    Ok((lat.fixed(7)?, lon.fixed(7)?))
}

fn span(words: &[Word<'_>]) -> std::ops::Range<usize> {
    let start = words.first().map_or(0, |word| word.start);
    start..words.last().map_or(start, |word| word.span().end)
}
