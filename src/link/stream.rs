//! Links over a byte stream with one peer: TCP, serial, pipe.

use std::time::Duration;

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::time::{Instant, sleep_until};

use super::core::{ConnectionEnd, LinkCore, LinkWork};
use super::peer::{PeerStream, StreamEnding};
use super::{LinkPeer, To};
use crate::text;

/// The only peer of a stream.
const PEER: LinkPeer = LinkPeer(0);
pub(super) const READ_LEN: usize = 16 * 1024;
/// After this long without a byte, an incomplete frame in the decoder is discarded as a false start.
pub(super) const PAUSE: Duration = Duration::from_millis(200);

/// Carries data until the stream ends. With `silence`, a peer that was heard and is then silent for
/// this long counts as gone, because a pulled cable does not close a TCP connection. The function
/// is long because a `select!` cannot be divided.
pub(super) async fn session<S>(
    link: &mut LinkCore,
    stream: S,
    silence: Option<Duration>,
) -> ConnectionEnd
where
    S: AsyncRead + AsyncWrite,
{
    let (mut reader, mut writer) = tokio::io::split(stream);
    let mut peer = PeerStream::new(&link.config, PEER);
    let mut input = vec![0; READ_LEN];
    let mut output = Vec::new();
    let mut last_read = None;
    let mut paused = true;
    link.meter.set_peers(1);
    loop {
        let heard_at = last_read.unwrap_or_else(Instant::now);
        tokio::select! {
            biased;
            work = link.next_work(output.is_empty()) => match work {
                LinkWork::End => return ConnectionEnd::Cancelled,
                LinkWork::Nothing => {}
                LinkWork::Send(batch) => {
                    let is_for_peer = |to: &To| *to != To::EveryoneBut(PEER);
                    let mine = batch.iter().filter(|(to, _)| is_for_peer(to));
                    let mut count = 0;
                    for (_, parcel) in mine {
                        peer.encode(parcel, &mut output, &link.meter);
                        count += 1;
                    }
                    link.meter.sent(count, output.len());
                }
            },
            read = reader.read(&mut input), if link.may_read() => match read {
                Ok(0) => return ConnectionEnd::Lost(text!("transport-closed")),
                Ok(count) => {
                    let frames = peer.receive(&input[..count], StreamEnding::Open, &mut link.meter);
                    link.deliver(PEER, frames);
                    last_read = Some(Instant::now());
                    paused = false;
                }
                Err(error) => return ConnectionEnd::Lost(error.to_string().into()),
            },
            written = writer.write(&output), if !output.is_empty() => match written {
                Ok(0) => return ConnectionEnd::Lost(text!("transport-takes-nothing")),
                Ok(count) => drop(output.drain(..count)),
                Err(error) => return ConnectionEnd::Lost(error.to_string().into()),
            },
            () = sleep_until(heard_at + PAUSE), if peer.has_tail() && !paused && link.may_read() => {
                let frames = peer.receive(&[], StreamEnding::Closed, &mut link.meter);
                link.deliver(PEER, frames);
                paused = true;
            }
            () = sleep_until(heard_at + silence.unwrap_or_default()),
                if silence.is_some() && last_read.is_some() && link.may_read() =>
            {
                let seconds = silence.unwrap_or_default().as_secs();
                return ConnectionEnd::Lost(text!("transport-silent", seconds = seconds));
            }
        }
    }
}
