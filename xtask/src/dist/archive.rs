//! Archives whose bytes depend on their files only: sorted, one time, one owner.

use std::collections::BTreeMap;
use std::io::{Cursor, Write as _};

use flate2::{Compression, GzBuilder};

use crate::step::Failed;

/// Format of an archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ArchiveFormat {
    TarGz,
    Zip,
}

impl ArchiveFormat {
    pub(super) fn extension(self) -> &'static str {
        match self {
            Self::TarGz => "tar.gz",
            Self::Zip => "zip",
        }
    }
}

/// A file of an archive.
#[derive(Clone, Debug)]
pub(super) struct PackedFile {
    pub(super) bytes: Vec<u8>,
    pub(super) is_executable: bool,
}

impl PackedFile {
    pub(super) fn data(bytes: impl Into<Vec<u8>>) -> Self {
        Self { bytes: bytes.into(), is_executable: false }
    }

    fn mode(&self) -> u32 {
        if self.is_executable { 0o755 } else { 0o644 }
    }
}

/// Files by their paths, with `/` on every system.
pub(super) type Files = BTreeMap<String, PackedFile>;

/// Packs files below a folder `name`, all with the time `time_s` [s since 1970].
pub(super) fn pack(
    format: ArchiveFormat,
    name: &str,
    files: &Files,
    time_s: u64,
) -> Result<Vec<u8>, Failed> {
    match format {
        ArchiveFormat::TarGz => tar_gz(name, files, time_s),
        ArchiveFormat::Zip => zip(name, files, time_s),
    }
    .map_err(|error| Failed(format!("cannot pack {name}: {error}")))
}

fn tar_gz(name: &str, files: &Files, time_s: u64) -> std::io::Result<Vec<u8>> {
    // No time and no system in the header of gzip.
    let packed = GzBuilder::new().operating_system(255).write(Vec::new(), Compression::best());
    let mut archive = tar::Builder::new(packed);
    for (path, file) in files {
        let mut header = tar::Header::new_gnu();
        header.set_size(file.bytes.len() as u64);
        header.set_mode(file.mode());
        header.set_mtime(time_s);
        header.set_uid(0);
        header.set_gid(0);
        archive.append_data(&mut header, format!("{name}/{path}"), file.bytes.as_slice())?;
    }
    archive.into_inner()?.finish()
}

fn zip(name: &str, files: &Files, time_s: u64) -> std::io::Result<Vec<u8>> {
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let time = dos_time(time_s);
    for (path, file) in files {
        let options = zip::write::SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Deflated)
            .compression_level(Some(9))
            .last_modified_time(time)
            .unix_permissions(file.mode());
        archive.start_file(format!("{name}/{path}"), options)?;
        archive.write_all(&file.bytes)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// The earliest time that ZIP can have replaces those before 1980.
fn dos_time(time_s: u64) -> zip::DateTime {
    let time = utc(time_s);
    zip::DateTime::from_date_and_time(
        time.year,
        time.month,
        time.day,
        time.hour,
        time.minute,
        time.second,
    )
    .unwrap_or_default()
}

/// Date and time in UTC.
pub(super) struct Utc {
    pub(super) year: u16,
    pub(super) month: u8,
    pub(super) day: u8,
    pub(super) hour: u8,
    pub(super) minute: u8,
    pub(super) second: u8,
}

/// Returns the date and time of a number of seconds since 1970.
pub(super) fn utc(time_s: u64) -> Utc {
    let (days, second_of_day) = (time_s / 86_400, time_s % 86_400);
    // Days since 0000-03-01 in eras of 400 years (Howard Hinnant, "chrono-compatible low-level date algorithms").
    let shifted = days + 719_468;
    let (era, day_of_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    Utc {
        year: (year_of_era + era * 400 + u64::from(month <= 2)) as u16,
        month: month as u8,
        day: day as u8,
        hour: (second_of_day / 3_600) as u8,
        minute: (second_of_day / 60 % 60) as u8,
        second: (second_of_day % 60) as u8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files() -> Files {
        let program = PackedFile { bytes: b"program".to_vec(), is_executable: true };
        [("b.txt".to_owned(), PackedFile::data("two")), ("a/periplus".to_owned(), program)].into()
    }

    #[test]
    fn a_tar_has_sorted_files_with_one_time_and_owner() {
        let packed = pack(ArchiveFormat::TarGz, "p", &files(), 1_000).unwrap();
        let mut archive = tar::Archive::new(flate2::read::GzDecoder::new(packed.as_slice()));
        let found: Vec<_> = archive
            .entries()
            .unwrap()
            .map(|entry| {
                let entry = entry.unwrap();
                let header = entry.header();
                let path = entry.path().unwrap().display().to_string();
                (path, header.mode().unwrap(), header.mtime().unwrap(), header.uid().unwrap())
            })
            .collect();
        let expected =
            [("p/a/periplus".to_owned(), 0o755, 1_000, 0), ("p/b.txt".to_owned(), 0o644, 1_000, 0)];
        assert_eq!(found, expected);
    }

    #[test]
    fn a_zip_has_sorted_files_with_one_time() {
        let packed = pack(ArchiveFormat::Zip, "p", &files(), 951_782_400).unwrap();
        let mut archive = zip::ZipArchive::new(Cursor::new(packed)).unwrap();
        let names: Vec<_> = archive.file_names().map(Result::unwrap).collect();
        assert_eq!(names, ["p/a/periplus", "p/b.txt"]);
        let program = archive.by_name("p/a/periplus").unwrap();
        assert_eq!(program.unix_mode().map(|mode| mode & 0o777), Some(0o755));
        let time = program.last_modified().unwrap();
        assert_eq!((time.year(), time.month(), time.day()), (2000, 2, 29));
    }

    #[test]
    fn the_same_files_make_the_same_bytes() {
        for format in [ArchiveFormat::TarGz, ArchiveFormat::Zip] {
            let pack = || pack(format, "p", &files(), 1_700_000_000).unwrap();
            assert_eq!(pack(), pack());
        }
    }
}
