//! What is on the disk before and after files are written.

use super::*;
use crate::document::Curve;
use crate::geometry::FloatPolygon;
use crate::io::TABLE;

fn curve() -> Curve {
    let points = [(0.0, 0.1), (1.0, 2.0), (3.0, 1e-300), (4.0, 0.0)];
    Curve::new("arc", FloatPolygon::planar(3, &points).unwrap())
}

fn document() -> Document {
    Document::from_curves([curve()])
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_is_written_whole_and_read_back() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.batten", "b.CSV"] {
        let path = folder.path().join(name);
        let saved = write_document(&path, &document(), None).unwrap();
        assert_eq!(saved.to_string(), "");
        assert_eq!(read_file(&path).unwrap().curves, [curve().into()]);
    }
    assert_eq!(names(folder.path()), ["a.batten", "b.CSV"]);
}

#[test]
fn what_cannot_be_read_or_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let check = |result: Result<(), FileError>, name: &str, expected: &str| {
        let path = folder.path().join(name);
        let message = result.unwrap_err().to_string();
        let expected = format!("{}: {expected}", path.display());
        assert!(
            message.starts_with(&expected),
            "{message}\nis not\n{expected}"
        );
    };
    let read = |name: &str| read_file(&folder.path().join(name)).map(|_| ());
    let write =
        |name: &str| write_document(&folder.path().join(name), &document(), None).map(|_| ());
    fs::create_dir(folder.path().join("folder.csv")).unwrap();
    fs::write(folder.path().join("bad.batten"), "{").unwrap();
    check(read("gone.batten"), "gone.batten", "cannot read the file: ");
    check(
        read("folder.csv"),
        "folder.csv",
        "this is a folder, not a file",
    );
    check(
        write("folder.csv"),
        "folder.csv",
        "this is a folder, not a file",
    );
    check(
        read("a.docx"),
        "a.docx",
        "“.docx” is not a format Batten knows",
    );
    check(write("a"), "a", "the name has no extension");
    check(read("bad.batten"), "bad.batten", "line 1, column 1: EOF");
    check(write("no/a.csv"), "no/a.csv", "the folder ");
    let result = write_document(&folder.path().join("a.dxf"), &Document::default(), None);
    check(result.map(|_| ()), "a.dxf", "there is no curve to write");
    assert_eq!(names(folder.path()), ["bad.batten", "folder.csv"]);
}

#[test]
fn a_file_that_is_too_large_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("huge.batten");
    // The file takes no room: it consists of a hole.
    File::create(&path)
        .unwrap()
        .set_len(MOST_BYTES + 1)
        .unwrap();
    let message = read_file(&path).unwrap_err().to_string();
    assert!(
        message.ends_with("larger than 1024 MiB, the most that Batten reads"),
        "{message}"
    );
    fs::write(&path, [b' '; 11]).unwrap();
    assert_eq!(read_at_most(&path, 11).unwrap().len(), 11);
    assert!(matches!(
        read_at_most(&path, 10),
        Err(FileProblem::TooLarge(10))
    ));
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};

    use super::*;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn permissions_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let (new, plain) = (folder.path().join("new.csv"), folder.path().join("plain"));
        write_bytes(&new, b"1").unwrap();
        File::create(&plain).unwrap();
        assert_eq!(mode(&new), mode(&plain), "as any new file");
        fs::set_permissions(&new, fs::Permissions::from_mode(0o640)).unwrap();
        write_bytes(&new, b"2").unwrap();
        assert_eq!(
            (mode(&new), fs::read(&new).unwrap()),
            (0o640, b"2".to_vec())
        );
        fs::set_permissions(&new, fs::Permissions::from_mode(0o444)).unwrap();
        let result = write_bytes(&new, b"3");
        assert!(matches!(result, Err(FileProblem::ReadOnly)), "{result:?}");
        assert_eq!(fs::read(&new).unwrap(), b"2");
    }

    #[test]
    fn owner_and_group_are_kept_as_far_as_the_system_allows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("shared.csv");
        write_bytes(&path, b"1").unwrap();
        // What root may give away anybody else may not; then the group of a member is tried.
        let given = chown(&path, Some(12_345), Some(23_456));
        if given.is_err() {
            let group = other_group();
            chown(&path, None, group).unwrap();
        }
        fs::set_permissions(&path, fs::Permissions::from_mode(0o660)).unwrap();
        let before = fs::metadata(&path).unwrap();
        write_bytes(&path, b"2").unwrap();
        let after = fs::metadata(&path).unwrap();
        assert_ne!(after.ino(), before.ino(), "it is a new file");
        assert_eq!((after.uid(), after.gid()), (before.uid(), before.gid()));
        assert_eq!(mode(&path), 0o660);
    }

    /// A group of this user that new files do not get by themselves, if there is one.
    fn other_group() -> Option<u32> {
        let output = std::process::Command::new("id").arg("-G").output().unwrap();
        let groups = String::from_utf8(output.stdout).unwrap();
        groups.split_whitespace().nth(1)?.parse().ok()
    }

    #[test]
    fn other_names_of_a_file_are_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.batten");
        let save = || write_document(&path, &document(), None).unwrap();
        assert_eq!(save().to_string(), "");
        for other in ["b", "c"] {
            fs::hard_link(&path, folder.path().join(other)).unwrap();
        }
        let old = fs::read(&path).unwrap();
        fs::write(&path, "shared").unwrap();
        assert_eq!(
            save().to_string(),
            "the file had 2 other names (hard links), which keep the old content"
        );
        assert_eq!(fs::read(&path).unwrap(), old);
        assert_eq!(fs::read(folder.path().join("b")).unwrap(), b"shared");
        assert_eq!(save().to_string(), "", "the link is broken now");
        fs::hard_link(&path, folder.path().join("d")).unwrap();
        assert_eq!(
            save().to_string(),
            "the file had another name (a hard link), which keeps the old content"
        );
    }

    #[test]
    fn messages_do_not_name_the_temporary_file() {
        // A folder of the system where nobody may create files, root neither.
        let path = Path::new("/proc/a.batten");
        if path.parent().is_some_and(Path::is_dir) {
            let error = write_bytes(path, b"").map_err(FileError::at(path));
            let message = error.unwrap_err().to_string();
            assert!(
                message.starts_with("/proc/a.batten: cannot write"),
                "{message}"
            );
            assert!(!message.contains(PREFIX), "{message}");
        }
    }

    #[test]
    fn links_are_followed() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("inner")).unwrap();
        let (link, second) = (folder.path().join("link.csv"), folder.path().join("second"));
        let real = folder.path().join("inner/real.csv");
        symlink("inner/real.csv", &second).unwrap();
        symlink("second", &link).unwrap();
        for content in [b"new", b"old"] {
            write_bytes(&link, content).unwrap();
            assert!(link.is_symlink() && second.is_symlink() && !real.is_symlink());
            assert_eq!(fs::read(&real).unwrap(), content);
        }
        let circle = folder.path().join("circle");
        symlink("circle", &circle).unwrap();
        assert!(matches!(
            write_bytes(&circle, b"x"),
            Err(FileProblem::System { .. })
        ));
    }
}

#[test]
fn what_killed_saves_left_is_removed_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.batten");
    let kept = [
        ".batten-backup",
        ".batten-backup2",
        ".batten-ab12",
        ".batten-abc123.batten",
        "batten-abc123",
    ];
    for name in kept {
        fs::write(folder.path().join(name), "mine").unwrap();
    }
    fs::create_dir(folder.path().join(".batten-folde0")).unwrap();
    // Two that are as killed saves leave them, and one that is being written.
    let left = beside(folder.path()).unwrap();
    fs::write(left.path(), "half a fi").unwrap();
    let (_, left) = left.keep().unwrap();
    fs::write(folder.path().join(".batten-abc123"), "").unwrap();
    let mut live = beside(folder.path()).unwrap();
    write_bytes(&path, b"new").unwrap();
    assert!(!left.exists(), "{left:?}");
    live.write_all(b"whole").unwrap();
    let moved = folder.path().join("b.batten");
    live.persist(&moved).unwrap();
    assert_eq!(fs::read(&moved).unwrap(), b"whole");
    let mut expected = kept.map(str::to_owned).to_vec();
    expected.extend([".batten-folde0", "a.batten", "b.batten"].map(str::to_owned));
    expected.sort();
    assert_eq!(names(folder.path()), expected);
}

#[test]
fn temporary_files_are_known_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    for _ in 0..100 {
        let temporary = beside(folder.path()).unwrap();
        let name = temporary.path().file_name().unwrap().to_str().unwrap();
        assert!(is_temporary_name(name), "{name}");
    }
}

#[test]
fn saves_at_the_same_time_do_not_disturb_each_other() {
    let folder = tempfile::tempdir().unwrap();
    std::thread::scope(|scope| {
        for thread in 0..8 {
            let path = folder.path().join(format!("{thread}.csv"));
            scope.spawn(move || {
                for turn in 0..50 {
                    write_bytes(&path, format!("{turn}").as_bytes()).unwrap();
                }
                assert_eq!(fs::read(&path).unwrap(), b"49");
            });
        }
    });
    assert_eq!(names(folder.path()).len(), 8);
}

#[test]
fn a_stream_is_read_under_its_name() {
    let stream = &b"# degree=1\nx,y\n0,0\n1,two\n"[..];
    let error = read_stream(stream, "standard input", &TABLE, None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "standard input: line 4: “two” in column y is not a number"
    );
}

#[test]
fn a_path_cannot_turn_or_break_a_message() {
    let path = Path::new("no\u{202e}folder\n/a.batten");
    let error = write_bytes(path, b"").map_err(FileError::at(path));
    let message = error.unwrap_err().to_string();
    assert_eq!(
        message,
        "no\\u{202e}folder\\n/a.batten: the folder no\\u{202e}folder\\n does not exist: create it first"
    );
    let error = read_file(Path::new(&format!("a.{}\u{202e}", "x".repeat(99)))).unwrap_err();
    assert!(error.to_string().contains("xxx…”"), "{error}");
}

#[test]
fn an_ignored_signal_is_known_from_the_status_of_the_process() {
    let status =
        |mask: &str| format!("Name:\tbatten\nSigBlk:\t0000\nSigIgn:\t{mask}\nSigCgt:\t0003\n");
    // SIGHUP is 1, SIGPIPE 13.
    let nohup = status("0000000000001001");
    assert!(is_ignored_in(&nohup, 1) && is_ignored_in(&nohup, 13));
    assert!(!is_ignored_in(&nohup, 2) && !is_ignored_in(&status("0000000000001000"), 1));
    for status in ["", "SigIgn:\n", "SigIgn:\tg\n"] {
        assert!(!is_ignored_in(status, 1), "{status}");
    }
    for signal in [i32::MIN + 1, 0, 65, i32::MAX] {
        assert!(!is_ignored_in(&nohup, signal), "{signal}");
    }
}
