//! Error codes of goals, from the blackboard entries that tree nodes write.

use periplus_behavior_tree::{Blackboard, TreeValue};
use periplus_costmap::Nav2Release;

use super::navigator::GoalError;
use super::parameters::BtNavigatorParams;

/// Names of the entries of codes and messages. In Jazzy the parameter names the codes; their messages have
/// the same names with `error_msg`.
fn entries(params: &BtNavigatorParams, release: Nav2Release) -> Vec<[String; 2]> {
    match release {
        Nav2Release::Main => {
            let prefixes = params.error_code_name_prefixes.iter();
            prefixes
                .map(|prefix| [format!("{prefix}_error_code"), format!("{prefix}_error_msg")])
                .collect()
        }
        _ => {
            let names = params.error_code_names.iter();
            names.map(|name| [name.clone(), name.replace("error_code", "error_msg")]).collect()
        }
    }
}

/// Lowest code that is not zero, with its message; the navigator's own error counts as well.
pub(super) fn of_goal(
    release: Nav2Release,
    params: &BtNavigatorParams,
    blackboard: Option<&Blackboard>,
    own: Option<GoalError>,
) -> GoalError {
    let text = |value: Option<&TreeValue>| value.and_then(TreeValue::to_text).unwrap_or_default();
    let of_entry = |[code, message]: [String; 2]| {
        let blackboard = blackboard?;
        let code = blackboard.get(&code)?.as_i64().and_then(|code| u16::try_from(code).ok())?;
        Some((code, text(blackboard.get(&message))))
    };
    // Only main has codes of the navigator itself.
    let own =
        own.map(|(code, message)| (if release == Nav2Release::Main { code } else { 0 }, message));
    if let Some((0, message)) = own {
        return (0, message);
    }
    let all = entries(params, release).into_iter().filter_map(of_entry).chain(own);
    all.filter(|(code, _)| *code != 0).min_by_key(|(code, _)| *code).unwrap_or_default()
}

/// Resets the entries after a goal.
pub(super) fn clear(params: &BtNavigatorParams, release: Nav2Release, blackboard: &mut Blackboard) {
    for [code, message] in entries(params, release) {
        // Trees may use such names for other types; these are left alone.
        let _ = blackboard.set(&code, 0_i64);
        let _ = blackboard.set(&message, "");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_code_wins() {
        let params = BtNavigatorParams::default();
        let mut blackboard = Blackboard::new();
        blackboard.set("compute_path_error_code", 208_i64).unwrap();
        blackboard.set("compute_path_error_msg", "no path").unwrap();
        blackboard.set("follow_path_error_code", 105_i64).unwrap();
        blackboard.set("follow_path_error_msg", "stuck").unwrap();
        blackboard.set("spin_error_code", 701_i64).unwrap();
        let of = |release, own: Option<(u16, &str)>| {
            let own = own.map(|(code, message)| (code, message.to_owned()));
            of_goal(release, &params, Some(&blackboard), own)
        };
        assert_eq!(of(Nav2Release::Main, None), (105, "stuck".to_owned()));
        assert_eq!(of(Nav2Release::Jazzy, None), (105, "stuck".to_owned()));
        assert_eq!(of(Nav2Release::Main, Some((9002, "tf"))), (105, "stuck".to_owned()));
        clear(&params, Nav2Release::Main, &mut blackboard);
        let none = of_goal(Nav2Release::Main, &params, Some(&blackboard), None);
        assert_eq!(none, (0, String::new()));
        let own = of_goal(Nav2Release::Jazzy, &params, None, Some((9001, "file".to_owned())));
        assert_eq!(own, (0, "file".to_owned()));
    }
}
