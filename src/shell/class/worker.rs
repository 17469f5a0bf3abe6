//! A thread that works with files, so that a slow disk holds neither the console nor its class.

use std::collections::VecDeque;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};

use tokio::sync::mpsc;

/// The maximum number of tasks that may be lost and of answers that wait.
const WAITING: usize = 1024;

/// A thread that answers every task with some answers. It ends when this is dropped.
#[derive(Debug)]
pub(super) struct Worker<T, A> {
    tasks: SyncSender<T>,
    answers: mpsc::Receiver<Vec<A>>,
    /// Tasks for which the thread has no room yet, oldest first.
    backlog: VecDeque<T>,
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
            backlog: VecDeque::new(),
            open: 0,
        })
    }

    /// Gives a task. It is never dropped: it waits until there is room.
    pub fn give(&mut self, task: T) {
        self.backlog.push_back(task);
        self.open += 1;
        self.hand_over();
    }

    /// Gives a task that comes again if it is lost; without room, it is dropped.
    pub fn offer(&mut self, task: T) {
        if self.backlog.is_empty() && self.tasks.try_send(task).is_ok() {
            self.open += 1;
        }
    }

    /// Gives the thread the waiting tasks for which it has room.
    fn hand_over(&mut self) {
        while let Some(task) = self.backlog.pop_front() {
            match self.tasks.try_send(task) {
                Ok(()) => {}
                Err(TrySendError::Full(task)) => {
                    self.backlog.push_front(task);
                    return;
                }
                Err(TrySendError::Disconnected(_)) => self.open -= 1,
            }
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
        self.hand_over();
        Some(answers)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use super::*;

    #[tokio::test]
    async fn tasks_that_must_not_be_lost_wait_and_others_are_dropped() {
        let held = Arc::new(Mutex::new(()));
        let gate = Arc::clone(&held);
        let guard = held.lock().expect("nobody holds it");
        let work = move |task: usize| {
            drop(gate.lock());
            vec![task]
        };
        let mut worker = Worker::start("test", work).expect("a thread");
        let count = WAITING * 2;
        (0..count).for_each(|task| worker.give(task));
        worker.offer(count);
        drop(guard);
        for expected in 0..count {
            assert_eq!(worker.next().await, Some(vec![expected]));
        }
        assert!(!worker.is_busy());
        worker.offer(7);
        assert_eq!(worker.next().await, Some(vec![7]));
    }
}
