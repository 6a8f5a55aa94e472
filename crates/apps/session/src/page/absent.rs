//! The page on a port in WebAssembly: there are no ports. A tab uses [`super::PageHub`].

use super::{PageContext, PageError};
use periplus_graph::Graph;

/// Running page: there is none.
#[derive(Debug)]
pub enum Page {}

/// Settings of a page: there are none.
#[derive(Clone, Debug)]
pub enum PageSettings {}

impl PageSettings {
    pub(crate) fn context(&self) -> &PageContext {
        match *self {}
    }
}

impl Page {
    pub(crate) fn open(_: &Graph, settings: &PageSettings) -> Result<Option<Self>, PageError> {
        match *settings {}
    }
}
