# Root mean square of the difference of two columns of colours over that of the second: reads two files that
# oiiotool --dumpdata printed.
# SPDX-License-Identifier: GPL-3.0-or-later
/Pixel/ { gsub(/[(),:]/, " ") }
/Pixel/ && NR == FNR { r[$3] = $4; g[$3] = $5; b[$3] = $6; next }
/Pixel/ {
    off += (r[$3] - $4) ^ 2 + (g[$3] - $5) ^ 2 + (b[$3] - $6) ^ 2
    all += $4 ^ 2 + $5 ^ 2 + $6 ^ 2
}
END { printf "%.4f\n", sqrt(off / all) }
