//! Openings of doc comments, and words that have a better term.

use std::ops::Range;

use super::{Check, Finding};
use crate::tidy::pattern::WordId;
use crate::tidy::prose::{Passage, Source, atoms};
use crate::tidy::rules::{Entry, Rules};

/// Number of atoms before and after a finding among which an allowed phrase may start.
const CONTEXT_ATOM_COUNT: usize = 8;

/// Objections to a passage, in the order of the text; the longest where several overlap.
pub(crate) fn check(passage: &Passage, rules: &Rules) -> Vec<Finding> {
    let atoms = atoms(passage);
    let mut ids = Vec::new();
    rules.words.number(&passage.text, &atoms, &mut ids);
    let finding = |check, entry: &str, hit: Range<usize>, advice: &str| {
        let range = atoms[hit.start].range.start..atoms[hit.end - 1].range.end;
        let text = passage.text[range.clone()].split_whitespace().collect::<Vec<_>>().join(" ");
        let start = passage.offset_in_file(range.start);
        let end = passage.offset_in_file(range.end);
        let (entry, advice) = (entry.to_owned(), advice.to_owned());
        Finding { check, entry, range: start..end.max(start), text, advice }
    };
    let mut findings = Vec::new();
    if matches!(passage.source, Source::Doc | Source::Help) {
        let mut matches = rules.openings.patterns.iter().filter_map(|pattern| {
            let is_anchor = ids.first().is_some_and(|id| pattern.anchors().contains(id));
            let hit = is_anchor.then(|| pattern.match_at(&ids, 0)).flatten()?;
            (hit.start == 0 && hit.end <= ids.len()).then_some(hit)
        });
        if let Some(hit) = matches.next()
            && !is_allowed(&rules.openings, &ids, &hit)
        {
            findings.push(finding(Check::Openings, "", hit, &rules.openings.advice()));
        }
    }
    let mut hits: Vec<(Range<usize>, &Entry)> = Vec::new();
    for (at, id) in ids.iter().enumerate() {
        for (entry, pattern) in rules.patterns_with(*id) {
            if let Some(hit) = pattern.match_at(&ids, at)
                && hit.end <= ids.len()
                && !is_allowed(entry, &ids, &hit)
            {
                hits.push((hit, entry));
            }
        }
    }
    hits.sort_by_key(|(hit, _)| (hit.start, std::cmp::Reverse(hit.end)));
    let mut covered_to = 0;
    for (hit, entry) in hits {
        if hit.start >= covered_to {
            covered_to = hit.end;
            findings.push(finding(Check::Words, &entry.name, hit, &entry.advice()));
        }
    }
    findings
}

/// True where a phrase that the entry allows overlaps with a hit.
fn is_allowed(entry: &Entry, ids: &[WordId], hit: &Range<usize>) -> bool {
    let near =
        hit.start.saturating_sub(CONTEXT_ATOM_COUNT)..(hit.end + CONTEXT_ATOM_COUNT).min(ids.len());
    entry.allowed.iter().any(|pattern| {
        near.clone()
            .filter(|&at| pattern.anchors().contains(&ids[at]))
            .filter_map(|at| pattern.match_at(ids, at))
            .any(|allowed| allowed.start < hit.end && hit.start < allowed.end)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULES: &str = "\
exempt: {}
classes:
  person: user people
openings:
  words: [what|who, those who]
  write: a noun phrase
  why: greppable
  allow: [what is new]
words:
- words: [so many]
  write: N
  why: vague
- words: [who]
  write: a node that
  why: programs are not people
  allow: [<person> who]
- words: [as it is told]
  write: as commanded
  why: idiom
- words: [told]
  write: commanded
  why: vague
constants: {folders: [], suffixes: [], counts: [], allow: []}
types: {shared: [], allow: [], exempt: []}
";

    #[track_caller]
    fn check_text(source: Source, text: &str, expected: &[&str]) {
        let rules = Rules::parse("words.yaml", RULES).expect("rules");
        let mut passage = Passage::new(source);
        passage.push(text, 0..text.len());
        let found: Vec<String> = check(&passage, &rules)
            .into_iter()
            .map(|finding| {
                assert_eq!(
                    text[finding.range].split_whitespace().collect::<Vec<_>>().join(" "),
                    finding.text
                );
                format!("{} {} -> {}", finding.check, finding.text, finding.advice)
            })
            .collect();
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn openings() {
        let advice = "a noun phrase (greppable)";
        check_text(Source::Doc, " What lies there.", &[&format!("openings What -> {advice}")]);
        check_text(
            Source::Help,
            "Those who",
            &[
                &format!("openings Those who -> {advice}"),
                "words who -> a node that (programs are not people)",
            ],
        );
        check_text(Source::Doc, "What is new", &[]);
        check_text(Source::Doc, "Map. What", &[]);
        check_text(Source::Comment, "What lies there.", &[]);
    }

    #[test]
    fn words() {
        check_text(Source::Comment, "Reads so\nmany", &["words so many -> N (vague)"]);
        check_text(Source::Comment, "A user who reads", &[]);
        check_text(
            Source::Comment,
            "It drives as it is told",
            &["words as it is told -> as commanded (idiom)"],
        );
    }

    /// Names of the entries of the data file that object to a doc comment.
    fn objections(text: &str) -> Vec<String> {
        let path = crate::step::root().join("xtask/tidy/words.yaml");
        let words = std::fs::read_to_string(path).expect("the words");
        let rules = Rules::parse("words.yaml", &words).expect("rules");
        let mut passage = Passage::new(Source::Doc);
        passage.push(text, 0..text.len());
        let name = |finding: Finding| match finding.check {
            Check::Openings => "opening".to_owned(),
            _ => finding.entry,
        };
        check(&passage, &rules).into_iter().map(name).collect()
    }

    #[test]
    fn the_data_file_objects_to_private_language() {
        for (text, expected) in [
            ("Every so manieth scan is used.", &["so many"][..]),
            ("Times the covariance of the place in `pose`.", &["place"]),
            (
                "Which type hashes are held against whom stands in",
                &["opening", "held against", "who", "stand"],
            ),
            ("What hands type works, and what it becomes is told.", &["opening", "told"]),
            ("A program with another is not heard", &["heard"]),
            ("Older ones are let fall. Who takes nothing is gone.", &["let fall", "who"]),
            ("A sensor that nobody hears", &["nobody", "heard"]),
            ("Whether somebody has said where it is", &["opening", "nobody", "said"]),
            ("Frames hang on others, files lie in `maps`", &["hang", "lie"]),
            (
                "Searched in vain, again and again, drawn anew",
                &["in vain", "again and again", "anew"],
            ),
            ("Moves as it is told on flat ground", &["as told", "ground"]),
            (
                "It is seldom astray: a fate of its own",
                &["opening", "seldom", "astray", "fate", "of its own"],
            ),
            ("After so much way the map is bent", &["so many", "way", "bend"]),
            ("The node that says it", &["said"]),
        ] {
            assert_eq!(objections(text), expected, "{text}");
        }
    }

    #[test]
    fn the_data_file_accepts_plain_english() {
        for text in [
            "Scan-matching pose refinement.",
            "Returns the transform in place; always away by the way.",
            "Robots that are placed by a user who clicks; it takes the place of a map.",
            "Places the robot. To place it, name `place` or `way`.",
            "The only way to read files, the other way round.",
            "Compared with ground truth; the ground plane of Gazebo.",
            "The robot stands still. `a` stands for `b`.",
            "The scanner is upside down, points lie on the plane.",
            "No lookups so far. As long as, so long as it runs.",
            "A mirror bends light. The lens bends rays.",
        ] {
            assert_eq!(objections(text), Vec::<String>::new(), "{text}");
        }
    }
}
