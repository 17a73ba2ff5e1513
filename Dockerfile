# The README's two commands on a system of its own, not as root:
#   docker build -t impact-paper . && docker run --rm impact-paper
# Compiler, crates and linker are those of rust-toolchain.toml, Cargo.lock and this image; what
# Debian brings below only starts programs.
FROM rust:1.95.0-slim-trixie
RUN apt-get update \
    && apt-get install -y --no-install-recommends git make python3 \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --create-home reader \
    && install --directory --owner reader --group reader /home/reader/impact-paper
USER reader
WORKDIR /home/reader/impact-paper
COPY --chown=reader . .
RUN make paper
RUN make test
CMD ["target/release/impact-paper", "check"]
