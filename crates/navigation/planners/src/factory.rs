//! Planners and smoothers by the class names of their plugins.

use std::fmt;

use periplus_costmap::Nav2Release;
use periplus_diagnostics::closest;
use periplus_params::{ParamValues, Table};

use crate::{
    Lattice, NavFnPlanner, Planner, SavitzkyGolaySmoother, SimpleSmoother, Smac2dPlanner,
    SmacHybridPlanner, Smoother, ThetaStarPlanner, tables,
};

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
    /// True for a class of Nav2 that is not supported.
    pub is_missing: bool,
}

/// Classes of Nav2 that are not supported.
const MISSING: [&str; 1] = ["nav2_constrained_smoother::ConstrainedSmoother"];

/// Cells and turning radius of the lattice that Nav2 uses by default.
const LATTICE_RESOLUTION_M: f64 = 0.05;
const LATTICE_RADIUS_M: f64 = 0.5;

impl fmt::Display for UnknownClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { class, plugin_type, near, known, is_missing } = self;
        if *is_missing {
            let known = known.join("`, `");
            return write!(
                f,
                "the {plugin_type} `{class}` of Nav2 is not supported; use one of `{known}`"
            );
        }
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
        let is_missing = MISSING.contains(&class.as_str());
        UnknownClass { class: written.to_owned(), plugin_type, near, known, is_missing }
    })
}

/// Class of a planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlannerKind {
    /// `nav2_navfn_planner::NavfnPlanner`.
    NavFn,
    /// `nav2_theta_star_planner::ThetaStarPlanner`.
    ThetaStar,
    /// `nav2_smac_planner::SmacPlanner2D`.
    Smac2d,
    /// `nav2_smac_planner::SmacPlannerHybrid`.
    SmacHybrid,
    /// `nav2_smac_planner::SmacPlannerLattice`.
    SmacLattice,
}

const PLANNERS: [(&str, PlannerKind); 5] = [
    ("nav2_navfn_planner::NavfnPlanner", PlannerKind::NavFn),
    ("nav2_theta_star_planner::ThetaStarPlanner", PlannerKind::ThetaStar),
    ("nav2_smac_planner::SmacPlanner2D", PlannerKind::Smac2d),
    ("nav2_smac_planner::SmacPlannerHybrid", PlannerKind::SmacHybrid),
    ("nav2_smac_planner::SmacPlannerLattice", PlannerKind::SmacLattice),
];

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
            Self::ThetaStar => &tables::THETA_STAR,
            Self::Smac2d => &tables::SMAC_2D,
            Self::SmacHybrid => &tables::SMAC_HYBRID,
            Self::SmacLattice => &tables::SMAC_LATTICE,
        }
    }

    /// Creates a planner with values of [`Self::table`]. A State Lattice planner gets the default lattice; for
    /// the file of its parameter `lattice_filepath` use [`SmacHybridPlanner::with_lattice`]. Parameters that were not given have the defaults of
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
    pub fn build(self, values: ParamValues, release: Nav2Release) -> Box<dyn Planner> {
        match self {
            Self::NavFn => Box::new(NavFnPlanner::new(values)),
            Self::ThetaStar => Box::new(ThetaStarPlanner::new(values)),
            Self::Smac2d => Box::new(Smac2dPlanner::new(values)),
            Self::SmacHybrid => Box::new(SmacHybridPlanner::new(values, release)),
            Self::SmacLattice => {
                let lattice = Lattice::ackermann(LATTICE_RESOLUTION_M, LATTICE_RADIUS_M);
                Box::new(SmacHybridPlanner::with_lattice(values, lattice))
            }
        }
    }
}

/// Class of a smoother.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SmootherKind {
    /// `nav2_smoother::SimpleSmoother`.
    Simple,
    /// `nav2_smoother::SavitzkyGolaySmoother`.
    SavitzkyGolay,
}

const SMOOTHERS: [(&str, SmootherKind); 2] = [
    ("nav2_smoother::SimpleSmoother", SmootherKind::Simple),
    ("nav2_smoother::SavitzkyGolaySmoother", SmootherKind::SavitzkyGolay),
];

impl SmootherKind {
    /// Returns the kind of a plugin class, in the form `pkg/Class` or `pkg::Class`.
    ///
    /// # Errors
    /// When there is no such smoother, with the most similar class.
    pub fn of_class(class: &str) -> Result<Self, UnknownClass> {
        find_class(class, "smoother", &SMOOTHERS)
    }

    /// Iterates over the classes of all smoothers.
    pub fn classes() -> impl Iterator<Item = &'static str> {
        SMOOTHERS.iter().map(|(class, _)| *class)
    }

    /// Returns the table of its parameters.
    #[must_use]
    pub fn table(self) -> &'static Table {
        match self {
            Self::Simple => &tables::SIMPLE_SMOOTHER,
            Self::SavitzkyGolay => &tables::SAVITZKY_GOLAY_SMOOTHER,
        }
    }

    /// Creates a smoother with values of [`Self::table`].
    #[must_use]
    pub fn build(self, values: ParamValues) -> Box<dyn Smoother> {
        match self {
            Self::Simple => Box::new(SimpleSmoother::new(values)),
            Self::SavitzkyGolay => Box::new(SavitzkyGolaySmoother::new(values)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_of_a_class_are_known() {
        for class in PlannerKind::classes() {
            let kind = PlannerKind::of_class(class).unwrap();
            assert_eq!(PlannerKind::of_class(&class.replace("::", "/")), Ok(kind));
            assert!(kind.table().faults().is_empty(), "{:?}", kind.table().faults());
            let _ = kind.build(ParamValues::defaults(kind.table()), Nav2Release::Humble);
        }
        for class in SmootherKind::classes() {
            let kind = SmootherKind::of_class(class).unwrap();
            assert!(kind.table().faults().is_empty(), "{:?}", kind.table().faults());
            let _ = kind.build(ParamValues::defaults(kind.table()));
        }
    }

    #[test]
    fn unknown_classes_are_answered_with_a_near_one() {
        let words = |class| PlannerKind::of_class(class).unwrap_err().to_string();
        assert_eq!(
            words("nav2_navfn_planner/NavFnPlanner"),
            "there is no planner `nav2_navfn_planner/NavFnPlanner`; did you mean \
             `nav2_navfn_planner::NavfnPlanner`?"
        );
        assert!(words("SmacPlannerHybrid").ends_with("`nav2_smac_planner::SmacPlannerHybrid`?"));
        let missing = SmootherKind::of_class("nav2_constrained_smoother/ConstrainedSmoother");
        assert!(missing.unwrap_err().to_string().contains("is not supported; use one of"));
        assert!(words("x").contains("known: `nav2_navfn_planner::NavfnPlanner`, "));
        let smoother = SmootherKind::of_class("nav2_smoother::SimpleSmother").unwrap_err();
        assert!(smoother.to_string().ends_with("did you mean `nav2_smoother::SimpleSmoother`?"));
    }
}
