//! Queue of messages that wait for their transforms.
//!
//! Source: the documentation of `tf2_ros::MessageFilter` (queue size, failure reasons).

use std::collections::VecDeque;
use std::sync::Arc;

/// Order in which a [`MessageFilter`] passes messages on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilterOrder {
    /// Each message as soon as its transforms are available, as in `tf2_ros::MessageFilter`.
    EachReady,
    /// All messages in the order of arrival; a message waits for those before it.
    InOrder,
    /// The oldest message with transforms. Transforms arrive in order, so messages before it never
    /// get theirs and are dropped.
    OldestReady,
    /// The newest message with transforms; those before it are dropped.
    NewestReady,
}

/// Settings of a [`MessageFilter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FilterSettings {
    /// Maximum number of waiting messages.
    pub max_waiting: usize,
    /// Time after arrival at which a message without transforms is dropped \[ns\].
    pub timeout_ns: i64,
    /// Order in which messages are passed on.
    pub order: FilterOrder,
}

/// Queue of messages that wait for their transforms, in the order of arrival. It is bounded: the
/// oldest message is dropped when a new one does not fit, and each after a time.
#[derive(Debug)]
pub struct MessageFilter<T> {
    settings: FilterSettings,
    /// Messages with their time of arrival \[ns\], oldest first.
    waiting: VecDeque<(i64, Arc<T>)>,
    superseded: u64,
    without_transforms: u64,
}

impl<T> MessageFilter<T> {
    /// Creates an empty queue.
    #[must_use]
    pub fn new(settings: FilterSettings) -> Self {
        Self { settings, waiting: VecDeque::new(), superseded: 0, without_transforms: 0 }
    }

    /// Adds a message that arrived at a time \[ns\]. Returns the oldest message if it was dropped for
    /// the new one.
    pub fn push(&mut self, arrival_ns: i64, message: Arc<T>) -> Option<Arc<T>> {
        self.waiting.push_back((arrival_ns, message));
        if self.waiting.len() <= self.settings.max_waiting {
            return None;
        }
        self.superseded += 1;
        self.waiting.pop_front().map(|(_, oldest)| oldest)
    }

    /// Removes and returns the next message whose transforms are available, with the result of
    /// `lookup`. `on_timeout` gets each message that is dropped after its timeout, with the error of
    /// `lookup`.
    pub fn next<R, E>(
        &mut self,
        now_ns: i64,
        mut lookup: impl FnMut(&T) -> Result<R, E>,
        on_timeout: impl FnMut(&T, E),
    ) -> Option<(Arc<T>, R)> {
        let mut ready =
            |(index, (_, message)): (usize, &(i64, Arc<T>))| Some((index, lookup(message).ok()?));
        let mut waiting = self.waiting.iter().enumerate();
        let (found, skipped) = match self.settings.order {
            FilterOrder::EachReady | FilterOrder::InOrder => {
                return self.next_of_each(now_ns, lookup, on_timeout);
            }
            FilterOrder::OldestReady => (waiting.find_map(ready), &mut self.without_transforms),
            FilterOrder::NewestReady => (waiting.rev().find_map(&mut ready), &mut self.superseded),
        };
        let Some((index, result)) = found else {
            return self.next_of_each(now_ns, lookup, on_timeout);
        };
        *skipped += index as u64;
        let (_, message) = self.waiting.drain(..=index).next_back()?;
        Some((message, result))
    }

    /// Checks the messages from the oldest one on, and drops those whose timeout is over.
    fn next_of_each<R, E>(
        &mut self,
        now_ns: i64,
        mut lookup: impl FnMut(&T) -> Result<R, E>,
        mut on_timeout: impl FnMut(&T, E),
    ) -> Option<(Arc<T>, R)> {
        let mut index = 0;
        loop {
            let (arrival_ns, message) = self.waiting.get(index)?;
            match lookup(message) {
                Ok(result) => {
                    let (_, message) = self.waiting.remove(index)?;
                    return Some((message, result));
                }
                Err(_) if now_ns - arrival_ns <= self.settings.timeout_ns => {
                    if self.settings.order != FilterOrder::EachReady {
                        return None;
                    }
                    index += 1;
                }
                Err(error) => {
                    on_timeout(message, error);
                    self.waiting.remove(index);
                    self.without_transforms += 1;
                }
            }
        }
    }

    /// Drops all messages, without counting them.
    pub fn clear(&mut self) {
        self.waiting.clear();
    }

    /// Number of waiting messages.
    #[must_use]
    pub fn len(&self) -> usize {
        self.waiting.len()
    }

    /// True if no message waits.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Number of messages that were dropped for newer ones.
    #[must_use]
    pub fn superseded(&self) -> u64 {
        self.superseded
    }

    /// Number of messages that were dropped because they had no transforms.
    #[must_use]
    pub fn without_transforms(&self) -> u64 {
        self.without_transforms
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Messages that were passed on, timed out, and still wait, and both counters.
    type Seen = (Vec<i32>, Vec<i32>, usize, (u64, u64));

    /// Messages 1 to 5 arrive at their second at a queue of four; some are ready.
    fn run(order: FilterOrder, ready: &[i32], now_s: i64) -> Seen {
        let settings = FilterSettings { max_waiting: 4, timeout_ns: 2, order };
        let mut filter = MessageFilter::new(settings);
        for number in 1..=5 {
            let dropped = filter.push(number.into(), Arc::new(number));
            assert_eq!(dropped.as_deref(), (number == 5).then_some(&1), "the oldest one");
        }
        let (mut passed, mut timed_out) = (Vec::new(), Vec::new());
        let lookup = |number: &i32| if ready.contains(number) { Ok(*number) } else { Err(*number) };
        while let Some((message, result)) = filter.next(now_s, lookup, |number, error| {
            assert_eq!(*number, error);
            timed_out.push(*number);
        }) {
            assert_eq!(*message, result);
            passed.push(result);
        }
        (passed, timed_out, filter.len(), (filter.superseded(), filter.without_transforms()))
    }

    #[test]
    fn each_message_is_passed_on_when_it_is_ready() {
        let seen = run(FilterOrder::EachReady, &[3, 5], 5);
        assert_eq!(seen, (vec![3, 5], vec![2], 1, (1, 1)));
    }

    #[test]
    fn messages_wait_for_those_before_them() {
        assert_eq!(run(FilterOrder::InOrder, &[3, 5], 4), (vec![], vec![], 4, (1, 0)));
        let seen = run(FilterOrder::InOrder, &[3, 5], 5);
        assert_eq!(seen, (vec![3], vec![2], 2, (1, 1)), "4 may still get its transforms");
        let seen = run(FilterOrder::InOrder, &[3, 5], 7);
        assert_eq!(seen, (vec![3, 5], vec![2, 4], 0, (1, 2)));
    }

    #[test]
    fn messages_before_a_ready_one_are_dropped() {
        let seen = run(FilterOrder::OldestReady, &[3, 4], 4);
        assert_eq!(seen, (vec![3, 4], vec![], 1, (1, 1)), "5 waits");
        let seen = run(FilterOrder::NewestReady, &[3, 4], 4);
        assert_eq!(seen, (vec![4], vec![], 1, (3, 0)), "5 waits");
        assert_eq!(run(FilterOrder::OldestReady, &[], 5), (vec![], vec![2], 3, (1, 1)));
        assert_eq!(run(FilterOrder::NewestReady, &[], 8), (vec![], vec![2, 3, 4, 5], 0, (1, 4)));
    }

    #[test]
    fn a_cleared_queue_passes_nothing_on() {
        let order = FilterOrder::EachReady;
        let settings = FilterSettings { max_waiting: 2, timeout_ns: 0, order };
        let mut filter = MessageFilter::new(settings);
        let _ = filter.push(0, Arc::new(1));
        filter.clear();
        assert!(filter.is_empty());
        assert_eq!(filter.next(0, |number| Ok::<_, ()>(*number), |_, ()| ()), None);
        assert_eq!((filter.superseded(), filter.without_transforms()), (0, 0));
    }
}
