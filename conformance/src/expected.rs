//! Expected results of a case.

use serde_json::Value;

use crate::used::is_remark;
use crate::{CaseReader, Unreadable};

/// Part of the expected results. It cannot be read, only compared
/// ([`crate::Differences::compare`]) or split into its members, so that every stated result is
/// compared. A value that is an input of the check, such as the ends of a ray, is an
/// [`Expected::input`].
#[derive(Clone, Debug)]
pub struct Expected<'v>(CaseReader<'v>);

impl<'v> Expected<'v> {
    pub(crate) fn new(reader: CaseReader<'v>) -> Self {
        Self(reader)
    }

    /// The path to it.
    #[must_use]
    pub fn path(&self) -> &str {
        self.0.path()
    }

    /// Input of the check that is given among the expected results.
    #[must_use]
    pub fn input(&self) -> CaseReader<'v> {
        self.0.clone()
    }

    /// True if the member is there, null or not.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.0.raw().get(name).is_some()
    }

    /// A member, if it is there, also if it is null.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<Self> {
        self.0.member(name).map(Self)
    }

    /// A member, if it is there and not null: null states nothing here.
    #[must_use]
    pub fn stated(&self, name: &str) -> Option<Self> {
        self.0.find(name).map(Self)
    }

    /// A member that must be there.
    ///
    /// # Errors
    /// When it is not.
    pub fn get(&self, name: &str) -> Result<Self, Unreadable> {
        self.0.get(name).map(Self)
    }

    /// True if it is null.
    #[must_use]
    pub fn is_null(&self) -> bool {
        self.0.raw().is_null()
    }

    /// True if it is a list.
    #[must_use]
    pub fn is_list(&self) -> bool {
        self.0.raw().is_array()
    }

    /// True if it is an object.
    #[must_use]
    pub fn is_object(&self) -> bool {
        self.0.raw().is_object()
    }

    /// The elements of a list.
    ///
    /// # Errors
    /// When it is none.
    pub fn list(&self) -> Result<Vec<Self>, Unreadable> {
        Ok(self.0.list()?.into_iter().map(Self).collect())
    }

    /// Elements of a list of distinct inputs, each with its expected result.
    ///
    /// # Errors
    /// When it is not a list, or two elements are the same.
    pub fn distinct(&self) -> Result<Vec<Self>, Unreadable> {
        let list = self.list()?;
        for (at, one) in list.iter().enumerate() {
            if list[..at].iter().any(|other| other.0.raw() == one.0.raw()) {
                return Err(one.unreadable("another element than those before it"));
            }
        }
        Ok(list)
    }

    /// The members of an object without its remarks, in the order of their names.
    ///
    /// # Errors
    /// When it is none.
    pub fn members(&self) -> Result<Vec<(&'v str, Self)>, Unreadable> {
        let members = self.0.members()?.into_iter();
        let stated = members.filter(|(name, value)| !is_remark(name, value.raw()));
        Ok(stated.map(|(name, value)| (name, Self(value))).collect())
    }

    /// Error that states the required type or value.
    #[must_use]
    pub fn unreadable(&self, wanted: &str) -> Unreadable {
        self.0.unreadable(wanted)
    }

    /// The value for a comparison, which counts as used from now on.
    pub(crate) fn compared(&self) -> &'v Value {
        self.0.whole()
    }
}
