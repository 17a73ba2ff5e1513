# Every target is one line that calls cargo, the program or a script. Requirements: Rust
# (rust-toolchain.toml names the version), make and a C compiler for linking; tests also run Python
# 3.9 or later (owner and public: 3.11), and cmark-gfm where it is installed.

.PHONY: paper quick check latex browser python owner public test test-checked test-long lint oldest deny identity archive bench measure clean help

paper: ## the whole reproduction, full profile, into paper/
	.ci/module && cargo run --release --locked -- paper && { .ci/owner || echo 'ro-crate-metadata.json has the hashes of before'; }

quick: ## the same with small samples, into target/paper-quick/
	.ci/module && cargo run --release --locked -- paper --profile quick

check: ## the verdict on every claim; fails if one does not hold
	cargo run --release --locked -- check

latex: ## compile the documents of paper/ with TeX Live, into target/latex (installed when missing)
	.ci/latex

browser: ## test the pages of paper/ in headless Chromium (Chromium and Node installed when missing)
	.ci/browser

python: ## build the wheel of the Python package, install it in target/python and run its tests
	.ci/python

owner: ## write owner.toml and the list of parts into all files that have them; .ci/owner --check names what is missing
	.ci/owner

public: ## test what is published beside the paper: owner, citations, schemas, archives' files, the README's commands
	python3 -B -m unittest discover -s tests/public

# Without the two packages that have no tests, whose dependencies ask for other features of crates
# that then are compiled twice.
TESTED = --workspace --exclude impact-bench --exclude impact-chain-python

test: ## all tests except the long one
	cargo test --release --locked $(TESTED)

test-long: ## the long test only (a job array on Slurm, which root installs when missing)
	cargo test --release --locked $(TESTED) -- --ignored

test-checked: ## the same tests with checks of overflow and debug assertions (compiles everything again)
	CARGO_TARGET_DIR=target/checked CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS=true CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS=true $(MAKE) test

mutants: ## small wrong changes of what computes, each against the tests of its crate: SHARD=K/N (installs cargo-mutants)
	.ci/mutants $(or $(SHARD),1/100)

lint: ## formatting, clippy, documentation, features, width of comments and spelling; warnings denied
	cargo fmt --check && for features in '' random serde ensembles methods; do cargo check --release --locked -p impact-chain --features "$$features" || exit 1; done && cargo clippy --release --locked --workspace --all-targets -- -D warnings && RUSTDOCFLAGS="-D warnings" cargo doc --release --locked --no-deps --document-private-items && .ci/columns && .ci/spell

oldest: ## the engine's crate with the oldest Rust that its Cargo.toml states (installed when missing)
	rustup toolchain install 1.89.0 --profile minimal --no-self-update && cargo +1.89.0 check --locked -p impact-chain --all-features --target-dir target/oldest

deny: ## licences, sources, duplicate versions and advisories of all crates (builds cargo-deny when missing: minutes)
	cargo install --quiet --locked --root target/deny cargo-deny@0.20.2 && target/deny/bin/cargo-deny --locked --workspace check

identity: ## the same bytes for any threads, folder, locale, C library and build (quick profile; minutes to build)
	.ci/identity

archive: ## pack the last commit and the source of all crates into target/impact-paper.tar.gz, which builds offline
	.ci/archive

bench: ## time the engine on this machine
	cargo bench --locked -p impact-bench

measure: ## time the engine, its rivals and other programs, and run these on the scenes, into benches/*.json (Python 3)
	python3 benches/peers/measure.py && python3 benches/peers/scenes/measure.py

clean: ## remove everything that was built, including saved results
	cargo clean

help: ## this list
	@sed -n 's/^\([a-z-]*\): ## /\1\t/p' Makefile | expand -t 12
