//! Names of the classes of labels.

use std::collections::BTreeMap;

use periplus_sim::LabelledObject;

/// Name of a class, as it is given on the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ClassName {
    pub(super) label: u8,
    pub(super) name: String,
}

/// Parses `LABEL=NAME`.
pub(super) fn class_name(word: &str) -> Result<ClassName, String> {
    let parts = word.split_once('=').and_then(|(label, name)| Some((label.parse().ok()?, name)));
    match parts {
        Some((label @ 1.., name)) if !name.trim().is_empty() => {
            Ok(ClassName { label, name: name.trim().to_owned() })
        }
        _ => Err("expected a label from 1 to 255 and its name, such as 1=person".to_owned()),
    }
}

/// Returns the names of all classes of a world, by their labels: the given name, or that of the first model with the label
/// without a number at its end.
pub(super) fn names(objects: &[LabelledObject], given: &[ClassName]) -> BTreeMap<u8, String> {
    let mut names: BTreeMap<u8, String> = BTreeMap::new();
    for object in objects {
        let model =
            object.model.trim_end_matches(|it: char| it.is_ascii_digit() || "_-. ".contains(it));
        let name = if model.is_empty() { object.model.as_str() } else { model };
        names.entry(object.label.class).or_insert_with(|| name.to_owned());
    }
    names.extend(given.iter().map(|class| (class.label, class.name.clone())));
    names
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{DVec3, Pose};
    use periplus_sim::ObjectLabel;

    use super::*;

    fn object(class: u8, instance: u16, model: &str) -> LabelledObject {
        LabelledObject {
            label: ObjectLabel { class, instance },
            model: model.to_owned(),
            world_from_box: Pose::IDENTITY,
            size_m: DVec3::ONE,
        }
    }

    #[test]
    fn classes_are_named_by_their_first_model_or_by_the_user() {
        let objects = [
            object(1, 1, "person_12"),
            object(1, 2, "guard"),
            object(2, 1, "42"),
            object(3, 1, "box"),
        ];
        let given = [class_name("3=crate").unwrap(), class_name("9=unseen").unwrap()];
        let found: Vec<(u8, String)> = names(&objects, &given).into_iter().collect();
        let expected = [(1, "person"), (2, "42"), (3, "crate"), (9, "unseen")];
        assert_eq!(found, expected.map(|(label, name)| (label, name.to_owned())));
    }

    #[test]
    fn wrong_names_are_rejected() {
        for word in ["person", "0=person", "256=person", "1=", "x=person"] {
            assert!(class_name(word).is_err(), "{word}");
        }
    }
}
