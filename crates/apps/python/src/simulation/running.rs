//! A running simulation, without Python: steps, deliveries, transforms.

use std::collections::VecDeque;
use std::time::Duration;

use periplus::graph::{
    Graph, GraphError, Mailbox, Node, Qos, RawCall, RawCalls, RawMailbox, Sample,
};
use periplus::msgs::tf2_msgs::TFMessage;
use periplus::os::Stopwatch;
use periplus::sim::{Diverged, RealTimePacer, Search, Simulation};
use periplus::tf::TransformKind;
use periplus::tf_ros::Frames;
use periplus_session::SimulationSession;

/// Longest time between two looks at signals and callbacks.
pub(crate) const SLICE: Duration = Duration::from_millis(40);

/// Wait for requests of clients while the world is paused.
const PAUSED_WAIT: Duration = Duration::from_millis(5);

/// A delivery to a callback.
pub(crate) enum Delivery {
    /// Message for the subscription of this number.
    Message(usize, Sample),
    /// Request to the service of this number.
    Request(usize, RawCall),
}

/// End of a slice of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SliceEnd {
    /// The goal is reached.
    Done,
    /// Callbacks are due, or signals are to be checked.
    Pause,
}

/// End of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Goal {
    /// A number of further steps.
    Steps(u64),
    /// A simulated time \[ns\].
    Time(i64),
}

/// A session with what Python added to it.
pub(crate) struct Running {
    pub(crate) session: SimulationSession,
    /// Node of the user's publishers, subscriptions and services.
    pub(crate) node: Node,
    pub(crate) search: Search,
    pub(crate) subscriptions: Vec<Option<RawMailbox>>,
    pub(crate) services: Vec<RawCalls>,
    pub(crate) due: VecDeque<Delivery>,
    pub(crate) transforms: Transforms,
    pub(crate) pacer: Option<RealTimePacer>,
}

/// Transforms of `/tf` and `/tf_static`.
pub(crate) struct Transforms {
    moving: Mailbox<TFMessage>,
    fixed: Mailbox<TFMessage>,
    pub(crate) frames: Frames,
}

/// Messages with transforms that wait between two steps.
const TRANSFORM_DEPTH: usize = 100;

impl Transforms {
    /// Subscribes to the transforms.
    pub(crate) fn new(node: &Node) -> Result<Self, GraphError> {
        Ok(Self {
            moving: node.mailbox("/tf", Qos::best_effort(TRANSFORM_DEPTH))?,
            fixed: node.mailbox("/tf_static", Qos::latched(TRANSFORM_DEPTH))?,
            frames: Frames::default(),
        })
    }

    pub(crate) fn receive(&mut self) {
        for message in self.fixed.drain() {
            self.frames.take(&message, TransformKind::Fixed);
        }
        for message in self.moving.drain() {
            self.frames.take(&message, TransformKind::Moving);
        }
    }
}

impl Running {
    pub(crate) fn simulation(&self) -> &Simulation {
        self.session.simulation()
    }

    pub(crate) fn graph(&self) -> &Graph {
        self.session.graph()
    }

    /// Works towards the goal, and updates it, until it is reached, callbacks are due, or it is time to look at
    /// signals.
    pub(crate) fn slice(&mut self, goal: &mut Goal) -> Result<SliceEnd, Diverged> {
        let stopwatch = Stopwatch::start();
        loop {
            let end_ns = match goal {
                Goal::Steps(0) => return Ok(SliceEnd::Done),
                Goal::Steps(_) => i64::MAX,
                Goal::Time(end_ns) if self.simulation().time_ns() >= *end_ns => {
                    return Ok(SliceEnd::Done);
                }
                Goal::Time(end_ns) => *end_ns,
            };
            if matches!(goal, Goal::Time(_)) && self.session.is_paused() {
                // Someone on the page or the network paused the world, and can continue it.
                self.session.serve();
                self.receive();
                periplus::os::sleep(PAUSED_WAIT);
                if let Some(pacer) = &mut self.pacer {
                    pacer.restart(self.session.simulation().time_ns());
                }
            } else {
                self.session.step_until(end_ns)?;
                if let Goal::Steps(left) = goal {
                    *left -= 1;
                }
                self.receive();
                if let Some(pacer) = &mut self.pacer {
                    pacer.wait(self.session.simulation().time_ns());
                }
            }
            if !self.due.is_empty() {
                return Ok(SliceEnd::Pause);
            }
            // The goal is checked first, so that short work ends without a second slice.
            if stopwatch.elapsed() > SLICE && !matches!(goal, Goal::Steps(0)) {
                return Ok(SliceEnd::Pause);
            }
        }
    }

    /// Drops what was received, after a jump in time.
    pub(crate) fn forget(&mut self) {
        self.receive();
        self.due.clear();
        self.transforms.frames.forget();
    }

    /// Serves requests and delivers messages at the present time, without a step.
    pub(crate) fn settle(&mut self) {
        self.session.serve();
        self.graph().settle();
        self.receive();
    }

    /// Takes what arrived for callbacks, in the order of subscriptions and messages.
    fn receive(&mut self) {
        for (number, mailbox) in self.subscriptions.iter().enumerate() {
            let Some(mailbox) = mailbox else { continue };
            let samples = mailbox.drain().into_iter();
            self.due.extend(samples.map(|sample| Delivery::Message(number, sample)));
        }
        for (number, calls) in self.services.iter().enumerate() {
            while let Some(call) = calls.take() {
                self.due.push_back(Delivery::Request(number, call));
            }
        }
        self.transforms.receive();
    }
}
