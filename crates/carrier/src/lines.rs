//! Lines of a stream, up to a limit.

use tokio::io::{AsyncBufRead, AsyncBufReadExt as _, AsyncReadExt as _};

/// A line, or what there is of one that is too long.
#[derive(Debug, PartialEq, Eq)]
pub enum ReadLine {
    /// A line with its line end, if it has one.
    Line(Vec<u8>),
    /// The line has more bytes than allowed; the rest of the stream cannot be read as lines.
    TooLong,
}

/// Reads a line of at most `most` bytes; `None` at the end of the stream, or if it fails.
pub async fn read_line(read: &mut (impl AsyncBufRead + Unpin), most: usize) -> Option<ReadLine> {
    let mut bytes = Vec::new();
    let mut part = read.take(most as u64 + 1);
    match part.read_until(b'\n', &mut bytes).await {
        Ok(0) | Err(_) => None,
        Ok(_) if bytes.len() > most => Some(ReadLine::TooLong),
        Ok(_) => Some(ReadLine::Line(bytes)),
    }
}
