//! Planners by the class names of their plugins.

use std::fmt;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::closest;
use periplus_params::{ParamValues, Table};

use crate::{NavFnPlanner, Planner, tables};

/// Class of a plugin that is not known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownClass {
    /// Class as written.
    pub class: String,
    /// Type of the plugin: planner or smoother.
    pub plugin_type: &'static str,
    /// Most similar known class.
    pub near: Option<&'static str>,
    /// All known classes.
    pub known: Vec<&'static str>,
}

impl fmt::Display for UnknownClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { class, plugin_type, near, known } = self;
        write!(f, "there is no {plugin_type} `{class}`")?;
        match near {
            Some(near) => write!(f, "; did you mean `{near}`?"),
            None => write!(f, "; known: `{}`", known.join("`, `")),
        }
    }
}

impl std::error::Error for UnknownClass {}

/// Finds the class that a user wrote, in the form `pkg/Class` (up to Humble) or `pkg::Class`.
pub(crate) fn find_class<K: Copy>(
    written: &str,
    plugin_type: &'static str,
    classes: &[(&'static str, K)],
) -> Result<K, UnknownClass> {
    let class = written.trim().replace('/', "::");
    let found = classes.iter().find(|(name, _)| *name == class);
    found.map(|(_, kind)| *kind).ok_or_else(|| {
        let known: Vec<&str> = classes.iter().map(|(name, _)| *name).collect();
        // A class without its package, or with another one.
        let last = |name: &str| name.rsplit("::").next().map(str::to_ascii_lowercase);
        let same = known.iter().copied().find(|name| last(name) == last(&class));
        let near = same.or_else(|| closest(&class, known.iter().copied()));
        UnknownClass { class: written.to_owned(), plugin_type, near, known }
    })
}

/// Class of a planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlannerKind {
    /// `nav2_navfn_planner::NavfnPlanner`.
    NavFn,
}

const PLANNERS: [(&str, PlannerKind); 1] =
    [("nav2_navfn_planner::NavfnPlanner", PlannerKind::NavFn)];

impl PlannerKind {
    /// Returns the kind of a plugin class, in the form `pkg/Class` or `pkg::Class`.
    ///
    /// # Errors
    /// When there is no such planner, with the most similar class.
    pub fn of_class(class: &str) -> Result<Self, UnknownClass> {
        find_class(class, "planner", &PLANNERS)
    }

    /// Iterates over the classes of all planners.
    pub fn classes() -> impl Iterator<Item = &'static str> {
        PLANNERS.iter().map(|(class, _)| *class)
    }

    /// Returns the table of its parameters.
    #[must_use]
    pub fn table(self) -> &'static Table {
        match self {
            Self::NavFn => &tables::NAVFN,
        }
    }

    /// Creates a planner with values of [`Self::table`]. Parameters that were not given have the defaults of
    /// the release.
    ///
    /// ```
    /// use periplus_costmap::Nav2Release;
    /// use periplus_params::ParamValues;
    /// use periplus_planners::PlannerKind;
    ///
    /// let kind = PlannerKind::of_class("nav2_navfn_planner/NavfnPlanner")?;
    /// let planner = kind.build(ParamValues::defaults(kind.table()), Nav2Release::Humble);
    /// assert_eq!(planner.max_planning_time_s(), None);
    /// # Ok::<(), periplus_planners::UnknownClass>(())
    /// ```
    #[must_use]
    pub fn build(self, values: ParamValues, _release: Nav2Release) -> Box<dyn Planner> {
        match self {
            Self::NavFn => Box::new(NavFnPlanner::new(values)),
        }
    }
}
