//! Runs to goals.

/// A run to a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoalRun {
    /// True if the robot reached the goal without a collision.
    pub is_success: bool,
    /// Length of the path that the robot took \[m\].
    pub length_m: f64,
    /// Length of the shortest path \[m\].
    pub shortest_m: f64,
}

impl GoalRun {
    /// Returns the path length divided by the shortest one; none for a shortest path of length zero.
    #[must_use]
    pub fn length_ratio(&self) -> Option<f64> {
        (self.shortest_m > 0.0).then(|| self.length_m / self.shortest_m)
    }
}

/// Returns the success weighted by path length, 0 to 1: the mean of `shortest / max(taken, shortest)` over
/// all runs, 0 for a run without success. None without runs.
///
/// Anderson et al. 2018, "On evaluation of embodied navigation agents".
#[must_use]
pub fn spl(runs: &[GoalRun]) -> Option<f64> {
    let of = |run: &GoalRun| match run.is_success {
        false => 0.0,
        // A goal at the start is reached by the shortest path.
        true if run.shortest_m <= 0.0 && run.length_m <= 0.0 => 1.0,
        true => run.shortest_m / run.length_m.max(run.shortest_m),
    };
    let sum: f64 = runs.iter().map(of).sum();
    (!runs.is_empty()).then(|| sum / runs.len() as f64)
}

/// Counts collisions in readings of a contact, each a stamp \[s\] and true while in contact. Contacts with
/// pauses shorter than `min_gap_s` are one collision.
#[must_use]
pub fn collision_count(contacts: &[(f64, bool)], min_gap_s: f64) -> usize {
    let mut last_s = f64::NEG_INFINITY;
    let mut count = 0;
    for &(stamp_s, _) in contacts.iter().filter(|it| it.1) {
        count += usize::from(stamp_s - last_s >= min_gap_s);
        last_s = stamp_s;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(is_success: bool, length_m: f64, shortest_m: f64) -> GoalRun {
        GoalRun { is_success, length_m, shortest_m }
    }

    #[test]
    fn detours_and_failures_lower_the_spl() {
        let check = |runs: &[GoalRun], expected: Option<f64>| assert_eq!(spl(runs), expected);
        check(&[], None);
        check(&[run(true, 4.0, 4.0), run(true, 8.0, 4.0), run(false, 4.0, 4.0)], Some(0.5));
        check(&[run(true, 3.9, 4.0)], Some(1.0));
        check(&[run(true, 0.0, 0.0)], Some(1.0));
        assert_eq!(run(true, 6.0, 4.0).length_ratio(), Some(1.5));
        assert_eq!(run(true, 6.0, 0.0).length_ratio(), None);
    }

    #[test]
    fn contacts_with_short_pauses_are_one_collision() {
        let contacts = [(0.0, false), (1.0, true), (1.1, false), (1.2, true), (5.0, true)];
        assert_eq!(collision_count(&contacts, 0.5), 2);
        assert_eq!(collision_count(&contacts, 0.1), 3);
        assert_eq!(collision_count(&[], 1.0), 0);
    }
}
