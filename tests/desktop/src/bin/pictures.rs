//! Takes the README's pictures of the real window: `pictures FOLDER`.

use std::path::PathBuf;

use anyhow::{Context, Result};
use batten_desktop_tests::arc::{self, correct_an_end};
use batten_desktop_tests::{Display, Window};
use egui::{Key, Modifiers};

fn main() -> Result<()> {
    let folder = std::env::args_os()
        .nth(1)
        .context("usage: pictures FOLDER")?;
    let folder = PathBuf::from(folder);
    let mut display = Display::start(1600, 1000)?;
    let mut window = Window::open(&mut display, &[], 1.0)?;
    window.resize(1480, 920)?;
    window.click("Not now")?;
    window.key(Key::H, Modifiers::NONE)?;
    window.picture(&folder.join("dark.png"))?;
    arc::open(&mut window)?;
    let canvas = window.find("Canvas")?;
    correct_an_end(&mut window, canvas)?;
    window.picture(&folder.join("end-fit.png"))?;
    window.key(Key::F9, Modifiers::NONE)?;
    window.picture(&folder.join("end-fit-light.png"))
}
