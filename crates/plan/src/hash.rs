//! A short name for the content of a list, as in "plan 7f3a".

use std::fmt;

use crc::{CRC_32_ISO_HDLC, Crc};

use crate::{HeightFrame, Item, ListKind, board, command};

const CRC_32: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// CRC-32 (ISO-HDLC) of the items of a list in the form in which the vehicle stores them
/// ([`board`]). It is the same for a file, for the list that a ground station sends and for the
/// list that the vehicle sends back: parameters that a command does not use are dropped, numbers
/// are truncated as in storage, the two numbers of a frame count as one, and commands without a
/// place have no frame and no place. Items that a vehicle refuses are hashed unchanged.
/// `auto_continue` does not count: ArduPilot does not keep it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContentHash(pub u32);

impl ContentHash {
    /// The hash of a list, without home.
    pub fn of(items: &[Item]) -> Self {
        let mut digest = CRC_32.digest();
        for item in items {
            let item = stored(item);
            let frame = match item.height_frame() {
                _ if !command::has_place(item.command) => 0,
                HeightFrame::SeaLevel => 1,
                HeightFrame::Home => 2,
                HeightFrame::Terrain => 3,
                HeightFrame::Other => item.frame.saturating_add(4),
            };
            digest.update(&item.command.to_le_bytes());
            digest.update(&[frame]);
            for param in item.params {
                digest.update(&normal(param).to_le_bytes());
            }
            digest.update(&item.x.to_le_bytes());
            digest.update(&item.y.to_le_bytes());
            // The vehicle stores heights in centimetres.
            digest.update(&((f64::from(normal(item.z)) * 100.0).round() as i64).to_le_bytes());
        }
        Self(digest.finalize())
    }
}

fn stored(item: &Item) -> Item {
    let kind = if command::is_fence(item.command) {
        ListKind::Fence
    } else if item.command == command::RALLY_POINT {
        ListKind::Rally
    } else {
        ListKind::Plan
    };
    // Not every command may be sent with parameters that are not set.
    let set = Item {
        params: item.params.map(normal),
        ..*item
    };
    board::kept(kind, &board::as_sent(&set)).unwrap_or(set)
}

/// Replaces NaN and negative zero by 0, so that they have the same hash.
fn normal(number: f32) -> f32 {
    if number.is_nan() || number == 0.0 {
        0.0
    } else {
        number
    }
}

impl fmt::Display for ContentHash {
    /// The first four hexadecimal digits: enough to tell the plans of a swarm apart.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04x}", self.0 >> 16)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAYPOINT: Item = Item {
        command: command::WAYPOINT,
        frame: 3,
        auto_continue: true,
        params: [0.0, 0.0, 0.0, f32::NAN],
        x: 504_501_000,
        y: 305_234_000,
        z: 20.0,
    };

    #[test]
    fn what_the_vehicle_spells_differently_has_the_same_hash_and_what_it_flies_differently_has_not()
    {
        let of = |item| ContentHash::of(&[item]);
        let same = Item {
            frame: 6,
            params: [0.9, -0.0, 7.0, 90.0],
            auto_continue: false,
            ..WAYPOINT
        };
        assert_eq!(of(same), of(WAYPOINT));
        for other in [
            Item {
                frame: 0,
                ..WAYPOINT
            },
            Item {
                z: 20.1,
                ..WAYPOINT
            },
            Item {
                x: 504_501_001,
                ..WAYPOINT
            },
            Item {
                command: command::SPLINE_WAYPOINT,
                ..WAYPOINT
            },
        ] {
            assert_ne!(of(other), of(WAYPOINT));
        }
        assert_eq!(of(WAYPOINT).to_string().len(), 4);
        let home = Item {
            command: command::RETURN_TO_LAUNCH,
            ..WAYPOINT
        };
        let bare = Item {
            command: command::RETURN_TO_LAUNCH,
            ..Item::default()
        };
        assert_eq!(of(home), of(bare));
    }

    /// Storage may change an item, but not its hash.
    #[test]
    fn a_list_has_the_same_hash_in_a_file_and_on_board() {
        let land = Item {
            command: command::LAND,
            ..WAYPOINT
        };
        let hold = Item {
            params: [2.5, 0.0, 0.0, f32::NAN],
            ..WAYPOINT
        };
        let stay = Item {
            command: command::LOITER_TIME,
            params: [10.0, 3.0, 0.0, 0.0],
            ..WAYPOINT
        };
        let circle = Item {
            command: command::FENCE_CIRCLE_INCLUSION,
            params: [40.0004, 2.0, 0.0, 0.0],
            ..WAYPOINT
        };
        let rally = Item {
            command: command::RALLY_POINT,
            params: [1.0; 4],
            z: 30.7,
            ..WAYPOINT
        };
        let place = Item {
            command: command::PAYLOAD_PLACE,
            params: [0.29, 0.0, 0.0, 0.0],
            z: 20.3,
            ..WAYPOINT
        };
        for (kind, sent) in [
            (ListKind::Plan, land),
            (ListKind::Plan, hold),
            (ListKind::Plan, stay),
            (ListKind::Plan, place),
            (ListKind::Fence, circle),
            (ListKind::Rally, rally),
        ] {
            let held = board::kept(kind, &board::as_sent(&sent)).expect("valid");
            assert_eq!(
                ContentHash::of(&[held]),
                ContentHash::of(&[sent]),
                "{sent:?}"
            );
        }
    }
}
