//! A connection that is closed when the other end stops reading.

use std::future::Future as _;
use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio::time::{Instant, Sleep, sleep};

/// A connection. Sending fails after the other end has read nothing for some time.
pub(super) struct Patient {
    stream: TcpStream,
    limit: Duration,
    stall: Pin<Box<Sleep>>,
    is_stalled: bool,
}

impl Patient {
    pub fn new(stream: TcpStream, limit: Duration) -> Self {
        Self {
            stream,
            limit,
            stall: Box::pin(sleep(limit)),
            is_stalled: false,
        }
    }

    fn judge(
        &mut self,
        context: &mut Context<'_>,
        sent: Poll<io::Result<usize>>,
    ) -> Poll<io::Result<usize>> {
        if sent.is_ready() {
            self.is_stalled = false;
            return sent;
        }
        if !self.is_stalled {
            self.is_stalled = true;
            self.stall.as_mut().reset(Instant::now() + self.limit);
        }
        let over = |()| Err(io::ErrorKind::TimedOut.into());
        self.stall.as_mut().poll(context).map(over)
    }
}

impl AsyncRead for Patient {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl AsyncWrite for Patient {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let sent = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.judge(context, sent)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let sent = Pin::new(&mut self.stream).poll_write_vectored(context, bytes);
        self.judge(context, sent)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
    use tokio::net::TcpListener;

    use super::*;

    async fn pair() -> (TcpStream, TcpStream) {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("it is bound");
        let (there, here) = tokio::join!(TcpStream::connect(address), listener.accept());
        (there.expect("it listens"), here.expect("it is asked").0)
    }

    #[tokio::test]
    async fn one_who_takes_nothing_is_given_up_on() {
        let (_there, here) = pair().await;
        let mut here = Patient::new(here, Duration::from_millis(50));
        // This is more than all buffers between the two hold.
        let error = async {
            loop {
                if let Err(error) = here.write_all(&vec![0; 65_536]).await {
                    return error;
                }
            }
        };
        assert_eq!(error.await.kind(), io::ErrorKind::TimedOut);
    }

    #[tokio::test]
    async fn one_who_takes_something_now_and_then_is_not() {
        let (mut there, here) = pair().await;
        let mut here = Patient::new(here, Duration::from_secs(60));
        let sent = tokio::spawn(async move {
            for _ in 0..200 {
                here.write_all(&vec![7; 65_536]).await?;
            }
            here.shutdown().await
        });
        let mut heard = Vec::new();
        there.read_to_end(&mut heard).await.expect("it is open");
        sent.await.expect("no panic").expect("it is taken");
        assert_eq!(heard.len(), 200 * 65_536);
    }
}
