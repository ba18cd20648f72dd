//! What is on the disk before and after files are written.

use super::*;
use crate::geometry::FloatPolygon;

fn curve() -> Curve {
    let points = [(0.0, 0.1), (1.0, 2.0), (3.0, 1e-300), (4.0, 0.0)];
    Curve::new("arc", FloatPolygon::planar(3, &points).unwrap())
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
        let saved = write_file(&path, &[curve()], &Extras::default(), None).unwrap();
        assert!(saved.is_quiet(), "{saved}");
        assert_eq!(read_file(&path).unwrap().curves, [curve()]);
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
    let write = |name: &str| {
        write_file(
            &folder.path().join(name),
            &[curve()],
            &Extras::default(),
            None,
        )
        .map(|_| ())
    };
    fs::create_dir(folder.path().join("folder.csv")).unwrap();
    fs::write(folder.path().join("bad.batten"), "{").unwrap();
    check(read("gone.batten"), "gone.batten", "cannot read the file: ");
    check(read("folder.csv"), "folder.csv", "this is not a file");
    check(write("folder.csv"), "folder.csv", "this is not a file");
    check(
        read("a.txt"),
        "a.txt",
        "“.txt” is not a format Batten knows",
    );
    check(write("a"), "a", "the name has no extension");
    check(read("bad.batten"), "bad.batten", "line 1, column 1: EOF");
    check(write("no/a.csv"), "no/a.csv", "the folder ");
    let none: [Curve; 0] = [];
    let result = write_file(
        &folder.path().join("a.dxf"),
        &none,
        &Extras::default(),
        None,
    );
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
    assert_eq!(read_bytes(&path, 11).unwrap().len(), 11);
    assert!(matches!(
        read_bytes(&path, 10),
        Err(FileError::TooLarge { .. })
    ));
}

#[cfg(unix)]
mod unix {
    use std::fs::Permissions;
    use std::os::unix::fs::{PermissionsExt, symlink};

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
        fs::set_permissions(&new, Permissions::from_mode(0o640)).unwrap();
        write_bytes(&new, b"2").unwrap();
        assert_eq!(
            (mode(&new), fs::read(&new).unwrap()),
            (0o640, b"2".to_vec())
        );
        fs::set_permissions(&new, Permissions::from_mode(0o444)).unwrap();
        let result = write_bytes(&new, b"3");
        assert!(
            matches!(result, Err(FileError::ReadOnly { .. })),
            "{result:?}"
        );
        assert_eq!(fs::read(&new).unwrap(), b"2");
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
            Err(FileError::System { .. })
        ));
    }
}
