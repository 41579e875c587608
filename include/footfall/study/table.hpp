// What a study gives back: columns of numbers with names and units, ready to print, to plot and to write.
#pragma once

#include <string>
#include <vector>

namespace footfall {

/// One column of a table. NaN stands for what does not exist (nothing bounced, no theory for this law).
struct Column {
    std::string name;         ///< as in CSV and JSON, snake_case: "peak_force"
    std::string unit;         ///< SI, as UDUNITS reads it; "1" where it has none
    std::string description;  ///< one phrase
    std::vector<double> values;
    std::string series = {};  ///< which law, or which curve, where a table has several; empty for what they share
};

/// Columns of the same length.
struct Table {
    std::string title;
    std::vector<Column> columns;
};

/// What the reader of a table says of it, in whole sentences.
struct TableRemarks {
    std::vector<std::string> notes;     ///< which columns were read as what, and what was left out
    std::vector<std::string> warnings;  ///< what a user may not have meant
};

}  // namespace footfall
