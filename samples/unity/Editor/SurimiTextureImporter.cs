// SPDX-License-Identifier: Apache-2.0
// Imports NAME.visibility*.exr as what it is: linear numbers, not a picture. BC6H, mip levels, clamped.
using UnityEditor;
using UnityEngine;

public class SurimiTextureImporter : AssetPostprocessor
{
    void OnPreprocessTexture()
    {
        string file = System.IO.Path.GetFileName(assetPath);
        if (!file.EndsWith(".exr") || !file.Contains(".visibility")) return;
        TextureImporter importer = (TextureImporter)assetImporter;
        importer.textureType = TextureImporterType.Default;
        importer.sRGBTexture = false;
        importer.alphaIsTransparency = false;
        importer.npotScale = TextureImporterNPOTScale.None;
        importer.mipmapEnabled = true;
        importer.wrapMode = TextureWrapMode.Clamp;
        importer.filterMode = FilterMode.Trilinear;
        importer.maxTextureSize = 8192;
        // Four channels do not fit into BC6H, and LTCGI's curve makes much of little: both stay half floats.
        bool isExact = file.Contains(".visibility-");
        TextureImporterPlatformSettings settings = importer.GetDefaultPlatformTextureSettings();
        settings.format = isExact ? TextureImporterFormat.RGBAHalf : TextureImporterFormat.Automatic;
        settings.textureCompression = TextureImporterCompression.CompressedHQ;
        importer.SetPlatformTextureSettings(settings);
        TextureImporterPlatformSettings desktop = importer.GetPlatformTextureSettings("Standalone");
        desktop.overridden = true;
        desktop.maxTextureSize = 8192;
        desktop.format = isExact ? TextureImporterFormat.RGBAHalf : TextureImporterFormat.BC6H;
        importer.SetPlatformTextureSettings(desktop);
    }
}
