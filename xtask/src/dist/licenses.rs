//! Licences of all crates and of the C code in them, as one text.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::packages::Package;
use crate::step::Failed;

/// Beginnings of the names of files with terms, in capital letters.
const NAMES: [&str; 5] = ["LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE"];

/// Depth of folders that are searched: sources of C have their terms below those of the crate.
const MAX_DEPTH: usize = 3;

/// Returns the terms of all foreign packages. Equal texts are printed once.
pub(super) fn text(packages: &[Package], apache: &str) -> Result<String, Failed> {
    let foreign: Vec<&Package> = packages.iter().filter(|it| it.is_foreign).collect();
    let mut names_by_text: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut without = Vec::new();
    for package in &foreign {
        let texts = terms(package, &foreign, apache);
        if texts.is_empty() {
            without.push(format!("{} {} ({})", package.name, package.version, package.license));
        }
        for text in texts {
            let names = names_by_text.entry(text).or_default();
            names.push(format!("{} {}", package.name, package.version));
        }
    }
    if !without.is_empty() {
        return Err(Failed(format!(
            "no text of the licence in the sources of {}: add a rule to xtask/src/dist/licenses.rs",
            without.join(", ")
        )));
    }
    let mut out = String::from("Periplus contains these libraries, under these terms.\n\n");
    for package in &foreign {
        out += &format!("{} {}: {}\n", package.name, package.version, package.license);
    }
    for (text, mut names) in names_by_text {
        names.dedup();
        let rule = "=".repeat(80);
        out += &format!("\n{rule}\n{}\n{rule}\n\n{}\n", names.join(", "), text.trim_end());
    }
    Ok(out)
}

/// Texts of a package: its own files, or those of a package of the same repository, or the text of the licence.
fn terms(package: &Package, all: &[&Package], apache: &str) -> Vec<String> {
    let own = read_all(&package.folder);
    if !own.is_empty() {
        return own;
    }
    let is_sibling = |other: &&&Package| {
        !package.repository.is_empty()
            && other.repository == package.repository
            && other.license == package.license
    };
    let siblings = all.iter().filter(is_sibling).map(|sibling| read_all(&sibling.folder));
    if let Some(texts) = siblings.into_iter().find(|texts| !texts.is_empty()) {
        return texts;
    }
    let accepts = |name: &str| package.license.split(" OR ").any(|it| it.trim() == name);
    if accepts("Apache-2.0") {
        return vec![apache.to_owned()];
    }
    let holders = package.authors.join(", ");
    match package.license.as_str() {
        "BSD-3-Clause" if !holders.is_empty() => vec![BSD_3_CLAUSE.replace("{holders}", &holders)],
        _ => Vec::new(),
    }
}

/// Contents of all files with terms, in the order of their paths.
fn read_all(folder: &Path) -> Vec<String> {
    let mut paths = Vec::new();
    find(folder, MAX_DEPTH, &mut paths);
    paths.sort();
    let texts = paths.iter().filter_map(|path| fs::read_to_string(path).ok());
    let mut texts: Vec<String> = texts.map(|it| it.replace("\r\n", "\n")).collect();
    texts.dedup();
    texts
}

fn find(folder: &Path, depth: usize, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok) {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().to_uppercase();
        let is_text = !name.ends_with(".RTF") && !name.ends_with(".RS");
        if path.is_dir() && depth > 1 {
            find(&path, depth - 1, paths);
        } else if path.is_file() && is_text && NAMES.iter().any(|it| name.starts_with(it)) {
            paths.push(path);
        }
    }
}

/// Text of the licence by its list (<https://spdx.org/licenses/BSD-3-Clause.html>).
const BSD_3_CLAUSE: &str = "\
Copyright (c) {holders}. All rights reserved.

Redistribution and use in source and binary forms, with or without modification, are permitted provided that the
following conditions are met:

1. Redistributions of source code must retain the above copyright notice, this list of conditions and the following
disclaimer.

2. Redistributions in binary form must reproduce the above copyright notice, this list of conditions and the following
disclaimer in the documentation and/or other materials provided with the distribution.

3. Neither the name of the copyright holder nor the names of its contributors may be used to endorse or promote
products derived from this software without specific prior written permission.

THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS \"AS IS\" AND ANY EXPRESS OR IMPLIED WARRANTIES,
INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE
DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT HOLDER OR CONTRIBUTORS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL,
SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR
SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY,
WHETHER IN CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE
OF THIS SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE.
";

#[cfg(test)]
mod tests {
    use super::*;

    fn package(name: &str, license: &str, repository: &str, folder: PathBuf) -> Package {
        Package {
            id: name.to_owned(),
            name: name.to_owned(),
            version: "1.0.0".to_owned(),
            license: license.to_owned(),
            authors: Vec::new(),
            repository: repository.to_owned(),
            description: String::new(),
            folder,
            is_foreign: true,
            dependencies: Vec::new(),
        }
    }

    #[test]
    fn a_package_without_a_text_has_that_of_its_repository() {
        let folder = std::env::temp_dir().join(format!("periplus-terms-{}", std::process::id()));
        fs::create_dir_all(folder.join("sources/c")).unwrap();
        fs::write(folder.join("LICENSE-MIT"), "terms of the crate\r\n").unwrap();
        fs::write(folder.join("sources/c/COPYING"), "terms of the C code").unwrap();
        let with = package("with", "MIT", "r", folder.clone());
        let without = package("without", "MIT", "r", folder.join("none"));
        let found = text(&[with.clone(), without], "apache").unwrap();
        assert!(found.contains("with 1.0.0, without 1.0.0\n"), "{found}");
        assert!(found.contains("terms of the C code"), "{found}");
        assert!(!found.contains('\r'));
        let stranger = package("stranger", "MIT", "other", folder.join("none"));
        let Failed(why) = text(&[with, stranger], "apache").unwrap_err();
        assert!(why.contains("stranger 1.0.0 (MIT)"), "{why}");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn one_of_several_licences_suffices() {
        let either = package("either", "MIT OR Apache-2.0", "", PathBuf::from("/nonexistent"));
        assert!(text(&[either], "the text").unwrap().ends_with("the text\n"));
    }
}
