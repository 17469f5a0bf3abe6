//! Sticks moved by keys, and the end of the program.

use std::net::UdpSocket;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    HEARTBEAT_DATA, MavAutopilot, MavMessage, MavModeFlag, MavType,
};
use sortie::wire::{Content, Decoder, Encoder};

use crate::terminal::Terminal;

/// Sends heartbeats of a copter until the flag is set and nothing more arrives; returns the first two channels
/// of each override that was heard.
fn listen(socket: &UdpSocket, ends: &AtomicBool, count: &AtomicUsize) -> Vec<[u16; 2]> {
    let wait = Duration::from_millis(100);
    socket.set_read_timeout(Some(wait)).expect("a socket");
    let (mut encoder, mut decoder) = (Encoder::new(1, 1), Decoder::new());
    let heartbeat = MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode: MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED,
        ..HEARTBEAT_DATA::DEFAULT
    });
    let (mut heard, mut console) = (Vec::new(), None);
    let mut buffer = [0; 2048];
    loop {
        // The flag is read first: what the console sent before it ended is already in the socket's queue.
        let is_last = ends.load(Ordering::Relaxed);
        let received = socket.recv_from(&mut buffer);
        if is_last && received.is_err() {
            return heard;
        }
        if let Ok((length, from)) = received {
            console = Some(from);
            decoder.push(&buffer[..length]);
            while let Some(frame) = decoder.next_frame() {
                if let Content::Message(MavMessage::RC_CHANNELS_OVERRIDE(data)) = &frame.content {
                    heard.push([data.chan1_raw, data.chan2_raw]);
                    count.store(heard.len(), Ordering::Relaxed);
                }
            }
        }
        let mut bytes = Vec::new();
        encoder.encode_message(&heartbeat, &mut bytes);
        if let Some(console) = console {
            // An error means that the console has ended.
            drop(socket.send_to(&bytes, console));
        }
    }
}

#[test]
fn quitting_releases_the_sticks_that_keys_hold() {
    let socket = UdpSocket::bind("127.0.0.1:0").expect("a port");
    let port = socket.local_addr().expect("bound").port();
    let (ends, count) = (
        Arc::new(AtomicBool::new(false)),
        Arc::new(AtomicUsize::new(0)),
    );
    let (seen, counted) = (Arc::clone(&ends), Arc::clone(&count));
    let vehicle = thread::spawn(move || listen(&socket, &seen, &counted));
    let address = format!("udp:127.0.0.1:{port}");
    let mut terminal = Terminal::start(&["connect", &address], 100, 30);
    terminal.see("1 vehicle").press("J");
    terminal.until("the sticks are held", |_| count.load(Ordering::Relaxed) > 3);
    // Ctrl+C quits; nothing is armed, so nobody is asked.
    terminal.press("\u{3}");
    assert_eq!(terminal.end(), 0);
    ends.store(true, Ordering::Relaxed);
    let heard = vehicle.join().expect("it ends");
    assert_eq!(heard.first(), Some(&[1500, 1500]), "{heard:?}");
    assert_eq!(heard.last(), Some(&[0, 0]), "they are released: {heard:?}");
}
