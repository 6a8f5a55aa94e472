//! The page on a port in WebAssembly: there are no ports. A tab uses [`super::PageHub`].

use super::{PageContext, PageError};
use periplus_graph::Graph;

/// Running page: there is none.
#[derive(Debug)]
pub enum NoPage {}

/// Settings of a page: there are none.
#[derive(Clone, Debug)]
pub enum NoPageSettings {}

impl NoPageSettings {
    pub(crate) fn context(&self) -> &PageContext {
        match *self {}
    }

    pub(crate) fn context_mut(&mut self) -> &mut PageContext {
        match *self {}
    }
}

impl NoPage {
    pub(crate) fn open(_: &Graph, settings: &NoPageSettings) -> Result<Option<Self>, PageError> {
        match *settings {}
    }
}
