# A printed page as a PPM picture: one line of text again and again, letters of 5 by 7 dots.
#   awk -f page.awk -v text='TWO RAYS' -v lines=8 -v dot=6 -v width=960 -v height=720
# SPDX-License-Identifier: GPL-3.0-or-later
function glyph(letter, rows) { split(rows, r, " "); for (k = 1; k <= 7; ++k) shape[letter, k] = r[k] }
BEGIN {
    glyph("A", "01110 10001 10001 11111 10001 10001 10001")
    glyph("E", "11111 10000 10000 11110 10000 10000 11111")
    glyph("F", "11111 10000 10000 11110 10000 10000 10000")
    glyph("M", "10001 11011 10101 10101 10001 10001 10001")
    glyph("N", "10001 11001 10101 10011 10001 10001 10001")
    glyph("O", "01110 10001 10001 10001 10001 10001 01110")
    glyph("R", "11110 10001 10001 11110 10100 10010 10001")
    glyph("S", "01111 10000 10000 01110 00001 00001 11110")
    glyph("T", "11111 00100 00100 00100 00100 00100 00100")
    glyph("W", "10001 10001 10001 10101 10101 11011 10001")
    glyph("Y", "10001 10001 01010 00100 00100 00100 00100")
    print "P3", width, height, 255
    pitch = height / lines
    left = (width - 6 * dot * length(text)) / 2
    for (y = 0; y < height; ++y) {
        row = int((y % pitch - (pitch - 7 * dot) / 2) / dot + 1)
        for (x = 0; x < width; ++x) {
            column = int((x - left) / dot)
            letter = x < left ? " " : substr(text, int(column / 6) + 1, 1)
            ink = row >= 1 && row <= 7 && (letter, row) in shape && substr(shape[letter, row], column % 6 + 1, 1) == "1"
            print ink ? "8 8 14" : "236 231 219"
        }
    }
}
