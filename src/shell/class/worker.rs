//! A thread that works with files, so that a slow disk holds neither the console nor its class.

use std::sync::mpsc::{SyncSender, sync_channel};

use tokio::sync::mpsc;

/// The maximum number of tasks that wait, and of answers.
const WAITING: usize = 1024;

/// A thread that answers every task with some answers. It ends when this is dropped.
#[derive(Debug)]
pub(super) struct Worker<T, A> {
    tasks: SyncSender<T>,
    answers: mpsc::Receiver<Vec<A>>,
    /// The number of tasks that are not answered yet.
    open: usize,
}

impl<T: Send + 'static, A: Send + 'static> Worker<T, A> {
    /// Starts the thread; `None` if the system has no room for one.
    pub fn start(name: &str, mut answer: impl FnMut(T) -> Vec<A> + Send + 'static) -> Option<Self> {
        let (tasks, given) = sync_channel::<T>(WAITING);
        let (answered, answers) = mpsc::channel(WAITING);
        let work = move || {
            for task in given {
                if answered.blocking_send(answer(task)).is_err() {
                    return;
                }
            }
        };
        let thread = std::thread::Builder::new().name(name.to_owned());
        thread.spawn(work).ok()?;
        Some(Self {
            tasks,
            answers,
            open: 0,
        })
    }

    /// Gives a task; without room, it is dropped.
    pub fn give(&mut self, task: T) {
        if self.tasks.try_send(task).is_ok() {
            self.open += 1;
        }
    }

    /// Whether a task is not answered yet.
    pub fn is_busy(&self) -> bool {
        self.open > 0
    }

    /// Waits for the next answers; `None` if the thread has ended.
    pub async fn next(&mut self) -> Option<Vec<A>> {
        let answers = self.answers.recv().await?;
        self.open = self.open.saturating_sub(1);
        Some(answers)
    }
}
