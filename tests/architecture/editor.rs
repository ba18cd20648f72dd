//! The methods of `Editor`: few, and only where the window's requests come in. Workspace, view, hand and
//! jobs have their own.

use crate::source::{Source, code, tokens};

/// The most methods that `Editor` may have.
const MOST_METHODS: usize = 90;

/// Whether a file may have methods of `Editor`.
fn may_extend_editor(path: &str) -> bool {
    let folders = ["editor/commands/", "editor/dispatch/"];
    path == "editor/mod.rs" || folders.iter().any(|folder| path.starts_with(folder))
}

/// Count the functions in the blocks `impl Editor { … }` of a source.
fn editor_methods(text: &str) -> usize {
    let code = code(text);
    let tokens = tokens(&code);
    let starts = tokens.windows(3).enumerate();
    let starts = starts.filter(|(_, window)| *window == ["impl", "Editor", "{"]);
    starts
        .map(|(index, _)| methods_in(&tokens[index + 2..]))
        .sum()
}

/// Count the functions directly inside the block that a list of tokens begins with.
fn methods_in(tokens: &[&str]) -> usize {
    let (mut depth, mut count) = (0, 0);
    for token in tokens {
        match *token {
            "{" => depth += 1,
            "}" if depth == 1 => break,
            "}" => depth -= 1,
            "fn" if depth == 1 => count += 1,
            _ => {}
        }
    }
    count
}

#[test]
fn the_editor_has_few_methods_in_few_places() {
    let mut sum = 0;
    for source in Source::all() {
        let count = editor_methods(&source.text);
        assert!(
            count == 0 || may_extend_editor(&source.path),
            "src/{} has methods of Editor: give them to workspace, view, hand or jobs",
            source.path
        );
        sum += count;
    }
    println!("Editor has {sum} methods");
    assert!(
        (1..=MOST_METHODS).contains(&sum),
        "Editor has {sum} methods"
    );
}

#[test]
fn methods_of_the_editor_are_counted() {
    let text =
        "impl Editor { fn a(&self) { fn inner() {} } pub fn b() {} } impl Hand { fn c() {} }";
    assert_eq!(editor_methods(text), 2);
    assert_eq!(
        editor_methods("impl fmt::Debug for Editor { fn a() {} }"),
        0
    );
    assert!(may_extend_editor("editor/commands/files.rs"));
    assert!(!may_extend_editor("editor/hand/hand.rs"));
}
