//! Unsaved drafts as one text, which survives the end of the program.

use std::fmt::Write as _;
use std::sync::Arc;

use super::Draft;
use crate::plan::{self, Document, FileFormat, Home, ListKind, Origin, ReadOptions};
use crate::vehicle_id::VehicleId;

/// The first line of the text, without the version of the format.
const HEAD: &str = "sortie drafts ";
/// The version of the format, and the previous one, whose drafts have no data about the vehicle.
const VERSION: &str = "2";
const FIRST_VERSION: &str = "1";
/// The first word of the line that begins a draft; a tab separates its parts.
const DRAFT: &str = "draft\t";
/// The beginning of a list's text.
const LIST: &str = "QGC WPL";
/// The sign for a missing part.
const NONE: &str = "-";

/// The drafts as a text: for each, a line with its vehicle, home, data about the vehicle and name, and then its lists as
/// `QGC WPL`; `None` without any.
pub fn kept_text<'a>(drafts: impl IntoIterator<Item = &'a Draft>) -> Option<String> {
    let mut text = String::new();
    for draft in drafts {
        let document = draft.document();
        let vehicle = draft.vehicle().map_or(NONE.to_owned(), |id| id.to_string());
        let home = document.home.map_or(NONE.to_owned(), |home| {
            format!("{} {} {}", home.x, home.y, home.z)
        });
        let origin = document.origin.map_or(NONE.to_owned(), |origin| {
            let Origin {
                firmware,
                vehicle,
                cruise_speed_m_s,
                hover_speed_m_s,
            } = origin;
            format!("{firmware} {vehicle} {cruise_speed_m_s} {hover_speed_m_s}")
        });
        let name = draft.name();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{DRAFT}{vehicle}\t{home}\t{origin}\t{name}");
        for kind in document.kinds() {
            // The format holds one list at a time.
            let mut own = Document {
                home: document.home,
                ..Document::default()
            };
            own.list_mut(kind).clone_from(document.list(kind));
            if let Ok(list) = plan::write(&own, FileFormat::Wpl(kind)) {
                text.push_str(&list);
            }
        }
    }
    (!text.is_empty()).then(|| format!("{HEAD}{VERSION}\n{text}"))
}

/// The drafts of a text; parts that cannot be read are left out.
pub fn kept_drafts(text: &str) -> Vec<Draft> {
    let Some(rest) = text.strip_prefix(HEAD) else {
        return Vec::new();
    };
    let has_origin = match rest.lines().next() {
        Some(VERSION) => true,
        Some(FIRST_VERSION) => false,
        _ => return Vec::new(),
    };
    let begins = format!("\n{DRAFT}");
    let mut parts = rest.split(begins.as_str());
    // Skips the text before the first draft.
    parts.next();
    parts.filter_map(|text| draft(text, has_origin)).collect()
}

fn draft(text: &str, has_origin: bool) -> Option<Draft> {
    let (head, lists) = text.split_once('\n').unwrap_or((text, ""));
    // The name is last, because it may contain anything.
    let mut words = head.splitn(if has_origin { 4 } else { 3 }, '\t');
    let vehicle: Option<VehicleId> = words.next()?.parse().ok();
    let home = words.next().and_then(home);
    let origin = has_origin.then(|| words.next()).flatten().and_then(origin);
    let name = words.next()?;
    let mut document = Document::default();
    for list in lists.split(LIST).skip(1) {
        let list = format!("{LIST}{list}\n");
        let Ok(loaded) = plan::read(list.as_bytes(), &ReadOptions::default()) else {
            continue;
        };
        for kind in ListKind::ALL {
            let items = loaded.document.list(kind);
            document.list_mut(kind).extend(items.iter().copied());
        }
    }
    (document.home, document.origin) = (home, origin);
    Some(Draft::new(name, Arc::new(document), vehicle))
}

fn home(text: &str) -> Option<Home> {
    let mut words = text.split(' ');
    Some(Home {
        x: words.next()?.parse().ok()?,
        y: words.next()?.parse().ok()?,
        z: words.next()?.parse().ok()?,
    })
}

fn origin(text: &str) -> Option<Origin> {
    let mut words = text.split(' ');
    Some(Origin {
        firmware: words.next()?.parse().ok()?,
        vehicle: words.next()?.parse().ok()?,
        cruise_speed_m_s: words.next()?.parse().ok()?,
        hover_speed_m_s: words.next()?.parse().ok()?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Item, command};

    fn item(command: u16, at: i32) -> Item {
        Item {
            command,
            frame: 3,
            auto_continue: true,
            params: [3.0, 0.0, 0.0, 0.0],
            x: 504_500_000 + at,
            y: 305_200_000,
            z: 20.5,
        }
    }

    #[test]
    fn drafts_are_the_same_after_they_were_kept() {
        let jump = Item {
            params: [1.0, 2.0, 0.0, 0.0],
            ..item(command::DO_JUMP, 0)
        };
        let placeless = Item {
            x: 0,
            y: 0,
            z: 0.0,
            ..jump
        };
        let whole = Document {
            home: Some(Home {
                x: 504_500_000,
                y: 305_200_000,
                z: 170.25,
            }),
            plan: vec![item(command::TAKEOFF, 0), item(16, 100), placeless],
            // A polygon that is still being drawn.
            fence: vec![item(command::FENCE_POLYGON_INCLUSION, 5); 2],
            rally: vec![item(command::RALLY_POINT, 9)],
            origin: Some(Origin {
                firmware: 3,
                vehicle: 13,
                cruise_speed_m_s: 15.0,
                hover_speed_m_s: 7.25,
            }),
        };
        let drafts = [
            Draft::new("north field.plan", Arc::new(whole), None),
            Draft::new(
                "vehicle-7",
                Arc::new(Document {
                    plan: vec![item(command::TAKEOFF, 1)],
                    ..Document::default()
                }),
                Some(7),
            ),
        ];
        let text = kept_text(&drafts).expect("two drafts");
        let again = kept_drafts(&text);
        assert_eq!(again.len(), 2, "{text}");
        for (before, after) in drafts.iter().zip(&again) {
            assert_eq!(after.name(), before.name());
            assert_eq!(after.vehicle(), before.vehicle());
            assert_eq!(after.document(), before.document(), "{text}");
        }
        // Older text, without the data about the vehicle.
        let old = "sortie drafts 1\ndraft\t7\t1 2 3\tnorth field\nQGC WPL 110\n";
        let read = kept_drafts(old);
        assert_eq!(read.len(), 1);
        assert_eq!(
            (read[0].name(), read[0].vehicle()),
            ("north field", Some(7))
        );
        assert!(read[0].document().home.is_some() && read[0].document().origin.is_none());
        assert_eq!(kept_text(&[]), None);
        assert!(kept_drafts("anything").is_empty());
    }
}
