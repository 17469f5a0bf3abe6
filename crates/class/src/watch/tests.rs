//! Any screens survive being sent, and no line of a seat can do harm.

use std::time::Duration;

use proptest::prelude::*;

use super::*;
use crate::protocol::{LONGEST_LINE, SeatMessage, line, read};

fn style() -> impl Strategy<Value = CellStyle> {
    let colour = || prop_oneof![Just(0_u32), 0x100_u32..0x110, 0x0100_0000_u32..0x0200_0000];
    (colour(), colour(), 0_u16..0x200).prop_map(|(foreground, background, attributes)| CellStyle {
        foreground,
        background,
        attributes,
    })
}

fn cell() -> impl Strategy<Value = PictureCell> {
    let symbol = prop_oneof![
        8 => "[ -~]",
        2 => "[а-яіїє│╭●]",
        1 => Just("e\u{301}".to_owned()),
        1 => Just("漢".to_owned()),
        1 => Just(String::new()),
        1 => ".{0,20}",
    ];
    (symbol, style()).prop_map(|(symbol, style)| PictureCell::new(&symbol, style))
}

/// A screen on which some cells are written.
fn picture() -> impl Strategy<Value = Picture> {
    let cells = prop::collection::vec((0_u16..14, 0_u16..6, cell()), 0..60);
    (0_u16..14, 0_u16..6, cells).prop_map(|(columns, rows, cells)| {
        let mut picture = Picture::blank(columns, rows);
        for (column, row, cell) in cells {
            picture.set(column, row, cell);
        }
        picture
    })
}

/// What a desk sees of what a seat sends in one tick.
fn send(sender: &mut PictureSender, receiver: &mut PictureReceiver, picture: &Picture, tick: u32) {
    let now = PICTURE_EVERY * tick;
    while let Some(part) = sender.next(|| Some(picture.clone()), now) {
        let line = line(&SeatMessage::Screen(part));
        assert!(line.len() <= LONGEST_LINE, "{}", line.len());
        let Ok(SeatMessage::Screen(part)) = read(line.as_bytes()) else {
            panic!("{line}");
        };
        receiver.receive(&part);
    }
}

proptest! {
    #[test]
    fn any_sequence_of_screens_arrives(pictures in prop::collection::vec(picture(), 1..8)) {
        let (mut sender, mut receiver) = (PictureSender::default(), PictureReceiver::default());
        for (tick, picture) in (0..).zip(&pictures) {
            send(&mut sender, &mut receiver, picture, tick);
            prop_assert_eq!(receiver.picture(), Some(picture));
            prop_assert!(!receiver.is_lost());
        }
    }

    #[test]
    fn lost_parts_show_and_a_new_whole_picture_mends_all(
        pictures in prop::collection::vec(picture(), 2..8),
        lost in prop::collection::vec(any::<bool>(), 8),
    ) {
        let (mut sender, mut receiver) = (PictureSender::default(), PictureReceiver::default());
        for (tick, (picture, is_lost)) in (0..).zip(pictures.iter().zip(lost)) {
            while let Some(part) = sender.next(|| Some(picture.clone()), PICTURE_EVERY * tick) {
                if !is_lost {
                    receiver.receive(&part);
                    prop_assert!(receiver.is_lost() || receiver.picture() == Some(picture));
                }
            }
        }
        let mut again = PictureSender::default();
        send(&mut again, &mut receiver, &pictures[0], 0);
        prop_assert_eq!(receiver.picture(), Some(&pictures[0]));
        prop_assert!(!receiver.is_lost());
    }

    #[test]
    fn changed_lines_do_no_harm(
        pictures in prop::collection::vec(picture(), 1..4),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let (mut sender, mut receiver) = (PictureSender::default(), PictureReceiver::default());
        for (tick, picture) in (0..).zip(&pictures) {
            while let Some(part) = sender.next(|| Some(picture.clone()), PICTURE_EVERY * tick) {
                let mut bytes = line(&SeatMessage::Screen(part)).into_bytes();
                for (at, byte) in &changes {
                    let at = at.index(bytes.len());
                    bytes[at] = if byte % 2 == 0 { *byte } else { b'0' + byte % 10 };
                }
                if let Ok(SeatMessage::Screen(part)) = read(&bytes) {
                    receiver.receive(&part);
                }
            }
        }
    }
}

/// A large screen on which no two neighbours look alike.
fn motley(columns: u16, rows: u16) -> Picture {
    let mut picture = Picture::blank(columns, rows);
    for row in 0..rows {
        for column in 0..columns {
            let foreground = 0x0100_0000 + u32::from(row) * 1000 + u32::from(column);
            let style = CellStyle {
                foreground,
                ..CellStyle::default()
            };
            picture.set(column, row, PictureCell::new("\"", style));
        }
    }
    picture
}

#[test]
fn a_large_screen_comes_in_parts_and_is_shown_when_all_are_there() {
    let (mut sender, mut receiver) = (PictureSender::default(), PictureReceiver::default());
    let small = Picture::blank(3, 2);
    send(&mut sender, &mut receiver, &small, 0);
    let large = motley(200, 50);
    let mut count = 0;
    while let Some(part) = sender.next(|| Some(large.clone()), PICTURE_EVERY) {
        receiver.receive(&part);
        count += 1;
        let shown = if part.more { &small } else { &large };
        assert_eq!(receiver.picture(), Some(shown));
    }
    assert!(count > 2, "{count}");
    let mut sender = PictureSender::default();
    let huge = motley(u16::MAX, 2);
    send(&mut sender, &mut receiver, &huge, 0);
    assert_eq!(receiver.picture().map(Picture::columns), Some(500));
}

#[test]
fn a_screen_that_stays_the_same_is_confirmed_once_a_second() {
    let mut sender = PictureSender::default();
    let picture = motley(20, 5);
    let mut sizes = Vec::new();
    for tick in 0..=20 {
        while let Some(part) = sender.next(|| Some(picture.clone()), PICTURE_EVERY * tick) {
            sizes.push((tick, line(&SeatMessage::Screen(part)).len()));
        }
    }
    let ticks: Vec<u32> = sizes.iter().map(|(tick, _)| *tick).collect();
    assert_eq!(ticks, [0, 10, 20]);
    assert!(sizes[1].1 < 60, "{sizes:?}");
}

#[test]
fn a_change_is_sent_at_once_but_no_more_than_ten_times_a_second() {
    let mut sender = PictureSender::default();
    let calm = motley(2, 2);
    let mut sent = Vec::new();
    for ms in 0..1000 {
        // The screen changes from 430 ms on, in each millisecond.
        let picture = if ms < 430 {
            calm.clone()
        } else {
            motley(3 + ms % 97, 2)
        };
        if sender
            .next(|| Some(picture), Duration::from_millis(ms.into()))
            .is_some()
        {
            sent.push(ms);
        }
    }
    assert_eq!(sent[0], 0);
    assert!((430..455).contains(&sent[1]), "{sent:?}");
    assert!(
        sent.windows(2).all(|pair| pair[1] - pair[0] >= 100),
        "{sent:?}"
    );
}

#[test]
fn a_cell_cannot_command_the_terminal() {
    let style = CellStyle::default();
    assert_eq!(PictureCell::new("\x1b[2J", style).symbol(), " [2J");
    assert_eq!(PictureCell::new(&"я".repeat(90), style).symbol().len(), 32);
    let evil = r#"{"screen":{"number":1,"size":[65535,65535],"styles":[[0,0,0]],"runs":[[4294967295,0,"a"]]}}"#;
    let Ok(SeatMessage::Screen(part)) = read(evil.as_bytes()) else {
        panic!("it is a message");
    };
    let mut receiver = PictureReceiver::default();
    receiver.receive(&part);
    assert!(receiver.is_lost());
    assert_eq!(receiver.picture(), None);
}
