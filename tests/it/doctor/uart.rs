//! The bytes that a serial port receives at a wrong baud rate.

/// The sender's signal: a start bit, eight bits from the least significant one, a stop bit, and a
/// pause of seven bits after every 30 bytes.
fn line(bytes: &[u8]) -> Vec<bool> {
    let mut line = vec![true; 20];
    for (at, byte) in bytes.iter().enumerate() {
        line.push(false);
        line.extend((0..8).map(|bit| byte >> bit & 1 == 1));
        line.push(true);
        if at % 30 == 29 {
            line.extend([true; 7]);
        }
    }
    line.extend([true; 20]);
    line
}

/// The bytes received if the receiver's bits last `ratio` times as long as the sender's.
pub(super) fn heard(bytes: &[u8], ratio: f64) -> Vec<u8> {
    let line = line(bytes);
    let level = |time: f64| line.get(time as usize).copied();
    let mut heard = Vec::new();
    let mut time = 0.0;
    while let Some(high) = level(time) {
        if high {
            time += ratio / 16.0;
            continue;
        }
        // Each bit is read at its middle; a missing stop bit is not detected.
        let bit = |number: u32| level(time + ratio * (f64::from(number) + 1.5)).unwrap_or(true);
        heard.push((0..8).fold(0, |byte, number| byte | u8::from(bit(number)) << number));
        time += ratio * 9.5;
        while level(time) == Some(false) {
            time += ratio / 16.0;
        }
    }
    heard
}

#[test]
fn at_the_right_rate_everything_is_heard() {
    let bytes: Vec<u8> = (0..=255).collect();
    assert_eq!(heard(&bytes, 1.0), bytes);
    assert_ne!(heard(&bytes, 0.5), bytes);
}
