# Copyright (c) the pcl_flashreg authors
# Filters a source on its way to Doxygen, which takes explicit instantiations of members for
# declarations that it doesn't find; lines keep their numbers.
undef $/;
$_ = <>;
s/^(extern )?template (?!<)[^;{]*;/(my $lines = $&) =~ tr#\n##cd; $lines/gems;
print;
