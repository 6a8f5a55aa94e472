//! The command of a run, as its recordings contain it.

use periplus_os::shell_word;

/// Options without influence on the result; the second part is true for options with a value.
const OMITTED_OPTIONS: [(&str, bool); 17] = [
    ("--threads", true),
    ("--record", true),
    ("--bag-compression", true),
    ("--token", true),
    ("--world-out", true),
    ("--slam-out", true),
    ("--costmap-picture", true),
    ("--costmap-cell", true),
    ("--gz-types", true),
    ("--ros2", true),
    ("--color", true),
    // Their values are joined by `=`.
    ("--page", false),
    ("--gz", false),
    ("--no-browser", false),
    ("--json", false),
    ("--quiet", false),
    ("-q", false),
];

/// Returns the command without options that do not change the result, quoted for a shell. Two runs with the same result
/// have the same command, on any machine, as far as the user typed the same paths.
pub(crate) fn recorded_command(words: &[String]) -> String {
    let mut kept = vec!["periplus".to_owned()];
    let mut words = words.iter().skip(1);
    while let Some(word) = words.next() {
        let name = word.split('=').next().unwrap_or(word);
        match OMITTED_OPTIONS.iter().find(|(option, _)| *option == name) {
            None => kept.push(shell_word(word)),
            Some((_, has_value)) => {
                if *has_value && name == word {
                    words.next();
                }
            }
        }
    }
    kept.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(line: &str, expected: &str) {
        let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        assert_eq!(recorded_command(&words), expected);
    }

    #[test]
    fn options_that_do_not_change_the_result_are_left_out() {
        check(
            "/usr/bin/periplus sim a.sdf --threads 8 --seed 7 --record=/tmp/x.mcap -q",
            "periplus sim a.sdf --seed 7",
        );
        check(
            "p sim a.sdf --threads=1 --seed=7 --record out --quiet",
            "periplus sim a.sdf --seed=7",
        );
        check("p sim a.sdf --page --no-browser --pose 1,2", "periplus sim a.sdf --pose 1,2");
        check("p sim a.sdf --page=0.0.0.0:1 --token secret-secret-1", "periplus sim a.sdf");
    }

    #[test]
    fn words_are_quoted_for_a_shell() {
        let words = ["periplus", "sim", "my world.sdf", "it's", "a:=b"].map(str::to_owned);
        assert_eq!(recorded_command(&words), r"periplus sim 'my world.sdf' 'it'\''s' a:=b");
    }
}
