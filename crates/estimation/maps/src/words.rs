//! Command lines of `map_saver_cli` and of `map_saver` of ROS 1.

use std::fmt;

use crate::distro::Distro;
use crate::save::Wish;

/// Parsed command line.
#[derive(Clone, Debug, PartialEq)]
pub enum Words {
    /// Print the usage.
    Help,
    /// Save a map.
    Save {
        /// Topic of the map, relative to the root namespace.
        topic: String,
        /// Save request.
        wish: Wish,
    },
}

/// Invalid command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongWords(String);

impl fmt::Display for WrongWords {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for WrongWords {}

/// Returns the usage text.
#[must_use]
pub fn usage(distro: Distro) -> &'static str {
    match distro {
        Distro::Noetic => {
            "  -h             this text\n  \
             -f NAME        save as NAME.pgm and NAME.yaml (map)\n  \
             --occ PERCENT  minimum occupancy of occupied cells, 1 to 100 (65)\n  \
             --free PERCENT maximum occupancy of free cells, 0 to 100 (25)\n  \
             FROM:=TO       rename a topic, such as map:=/other_map\n"
        }
        Distro::Humble | Distro::Jazzy => {
            "  -h, --help     this text\n  \
             -t TOPIC       the topic of the map (map)\n  \
             -f NAME        save as NAME.yaml and NAME.pgm (map_SECONDS)\n  \
             --occ RATIO    minimum occupancy of occupied cells, 0 to 1 (0.65)\n  \
             --free RATIO   maximum occupancy of free cells, 0 to 1 (0.25)\n  \
             --fmt FORMAT   pgm, png or bmp (pgm; png in mode scale)\n  \
             --mode MODE    trinary, scale or raw (trinary)\n"
        }
    }
}

/// Parses the arguments as the saver of a distribution does. Arguments after `--ros-args` are
/// ignored.
/// # Errors
/// The invalid argument.
pub fn read_words(words: &[String], distro: Distro) -> Result<Words, WrongWords> {
    let (mut topic, mut wish) = ("map".to_owned(), Wish::default());
    let is_noetic = distro == Distro::Noetic;
    let mut rest = words.iter().map(String::as_str);
    while let Some(word) = rest.next() {
        let is_known = match word {
            "-h" => return Ok(Words::Help),
            "--help" if !is_noetic => return Ok(Words::Help),
            "--ros-args" => break,
            "-f" | "--occ" | "--free" => true,
            "-t" | "--mode" | "--fmt" => !is_noetic,
            _ => false,
        };
        if !is_known {
            // ROS 1 remaps by arguments in any position, and has special arguments.
            if let Some((from, to)) = word.split_once(":=").filter(|_| is_noetic) {
                if from.trim_start_matches('/') == "map" {
                    to.clone_into(&mut topic);
                }
                continue;
            }
            return Err(unknown(word, is_noetic));
        }
        let value = rest.next().ok_or_else(|| WrongWords(format!("`{word}` needs a value")))?;
        match word {
            "-t" => value.clone_into(&mut topic),
            "-f" => value.clone_into(&mut wish.name),
            "--mode" => value.clone_into(&mut wish.mode),
            "--fmt" => value.clone_into(&mut wish.image_format),
            "--occ" => wish.occupied_thresh = threshold(word, value, is_noetic)?,
            _ => wish.free_thresh = threshold(word, value, is_noetic)?,
        }
    }
    Ok(Words::Save { topic, wish })
}

/// Parses a threshold as a ratio: ROS 1 uses whole percentages.
fn threshold(word: &str, value: &str, is_percent: bool) -> Result<f64, WrongWords> {
    if is_percent {
        let least = if word == "--occ" { 1 } else { 0 };
        return match value.parse::<u8>() {
            Ok(percent) if (least..=100).contains(&percent) => Ok(f64::from(percent) / 100.0),
            _ => Err(WrongWords(format!(
                "`{word}` needs a whole percentage from {least} to 100, not `{value}`"
            ))),
        };
    }
    value.parse().map_err(|_| WrongWords(format!("`{word}` needs a number, not `{value}`")))
}

fn unknown(word: &str, is_noetic: bool) -> WrongWords {
    let looks_like_a_name = !word.starts_with('-');
    WrongWords(match (looks_like_a_name, is_noetic) {
        (true, _) => format!("`{word}` is not expected; write the name after `-f`"),
        (false, true) if matches!(word, "-t" | "--mode" | "--fmt") => {
            format!("`{word}` is an option of ROS 2; here remap the topic with `map:=/other_map`")
        }
        (false, _) => format!("`{word}` is not an option of the map saver"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &str, distro: Distro) -> Result<Words, WrongWords> {
        let words: Vec<String> = words.split_whitespace().map(str::to_owned).collect();
        read_words(&words, distro)
    }

    #[test]
    fn words_of_ros_2() {
        let all = "-t /m -f a/b --occ 0.7 --free 0.1 --fmt png --mode raw --ros-args -p x:=1";
        let wish = Wish {
            name: "a/b".into(),
            image_format: "png".into(),
            mode: "raw".into(),
            occupied_thresh: 0.7,
            free_thresh: 0.1,
        };
        assert_eq!(read(all, Distro::Jazzy), Ok(Words::Save { topic: "/m".into(), wish }));
        assert_eq!(read("-f a -h", Distro::Jazzy), Ok(Words::Help));
        for wrong in ["--mode", "--free 0 0", "--occ x", "-x", "map:=/m"] {
            assert!(read(wrong, Distro::Jazzy).is_err(), "{wrong}");
        }
    }

    #[test]
    fn words_of_ros_1() {
        let wish = Wish { name: "room".into(), occupied_thresh: 0.9, ..Wish::default() };
        let save = Words::Save { topic: "/dynamic_map".into(), wish };
        assert_eq!(read("--occ 90 -f room map:=/dynamic_map __name:=x", Distro::Noetic), Ok(save));
        for wrong in ["--occ 0", "--occ 0.65", "--free 101", "-t /m", "room"] {
            assert!(read(wrong, Distro::Noetic).is_err(), "{wrong}");
        }
    }
}
