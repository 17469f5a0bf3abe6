//! A link's task, from opening to end.

use std::time::Duration;

use super::core::{ConnectionEnd, LinkCore};
use super::{Address, LinkState, Transport, connect, playback, stream};
use crate::text;
use crate::text::Text;

const FIRST_RETRY: Duration = Duration::from_millis(250);
const LONGEST_RETRY: Duration = Duration::from_secs(5);

/// Runs a link until its end.
pub(super) async fn run(mut link: LinkCore, transport: Transport) {
    let reason = match transport {
        Transport::Pipe(pipe) | Transport::Sitl(_, pipe) => {
            link.up(None);
            match stream::session(&mut link, pipe, None).await {
                ConnectionEnd::Cancelled => None,
                ConnectionEnd::Final(reason) => reason,
                ConnectionEnd::Lost(reason) => Some(text!("transport-pipe-gone", reason = reason)),
            }
        }
        Transport::Address(Address::File { path }) => playback::play(&mut link, &path).await,
        Transport::Address(address) => reconnect_for_ever(&mut link, &address).await,
    };
    link.close();
    link.meter.down(LinkState::Ended, reason);
}

/// Opens an address repeatedly; returns the reason if it gives up.
async fn reconnect_for_ever(link: &mut LinkCore, address: &Address) -> Option<Text> {
    let mut retry_in = FIRST_RETRY;
    loop {
        link.meter.down(LinkState::Connecting, None);
        let reason = match connect::attempt(link, address).await {
            ConnectionEnd::Cancelled => return None,
            ConnectionEnd::Final(reason) => return reason,
            ConnectionEnd::Lost(reason) => reason,
        };
        // A server that accepts a connection and closes it at once does not count as a success.
        if link.meter.take_heard() {
            retry_in = FIRST_RETRY;
        }
        let state = LinkState::Waiting { retry_in };
        link.meter.down(state, Some(reason));
        link.drop_queued();
        link.meanwhile(tokio::time::sleep(retry_in)).await?;
        retry_in = (2 * retry_in).min(LONGEST_RETRY);
    }
}
