#version 330 core
// Provides: which surface a pixel shows, as its number plus one, so that an empty picture is 0. Single precision counts
// to 2^24.
flat in float place;

out float number;

void main() {
    number = place;
}
