fn main() -> anyhow::Result<()> {
    batten::ui::run(std::env::args_os().skip(1).map(Into::into).collect())
}
