//! Recordings that clients replay, record and upload.
//!
//! A [`Recordings`] has the recordings of a server. Each client that asks for them has a
//! `RecordingClient`: fetches run on threads of that client, so that neither the thread of its
//! socket nor another client waits for them, and they pause while the client does not read.

mod background;
mod client;
mod density;
mod entry;
mod fetch;
mod file;
mod jobs;
mod latched;
mod live;
mod marker_index;
mod marks;
mod messages;
mod number_path;
mod series;
mod service;
mod state;
mod summary;
mod transform_index;
mod upload;

pub(crate) use client::RecordingClient;
pub use jobs::{JobError, JobRequest, Jobs};
pub use service::{OpenRecordingError, RecordingSettings, Recordings};
